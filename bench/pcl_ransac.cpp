// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Plane RANSAC of PCL as a worker of `flagstone bench --compare`; bench/external_worker.py
// describes the protocol. The threshold is 0.2 m, as in flagstone's RANSAC, with at most 1,000
// iterations. Other parameters have PCL's defaults.
#include <pcl/ModelCoefficients.h>
#include <pcl/PointIndices.h>
#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// Reads a cloud. Points that are not finite or all zero are omitted.
Cloud::Ptr read_cloud(std::size_t count) {
  std::vector<std::array<float, 4>> rows(count);
  std::cin.read(reinterpret_cast<char*>(rows.data()),
                static_cast<std::streamsize>(count * sizeof rows[0]));
  Cloud::Ptr cloud(new Cloud);
  for (const auto& [x, y, z, intensity] : rows) {
    const bool is_finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
    if (is_finite && (x != 0 || y != 0 || z != 0)) cloud->push_back(pcl::PointXYZ(x, y, z));
  }
  return cloud;
}

/// Prints the time in nanoseconds and the number of points on the plane.
void run(const Cloud::ConstPtr& cloud) {
  pcl::PointIndices inliers;
  pcl::ModelCoefficients plane;
  const auto start = std::chrono::steady_clock::now();
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(0.2);
  segmentation.setMaxIterations(1000);
  segmentation.setInputCloud(cloud);
  segmentation.segment(inliers, plane);
  const std::chrono::nanoseconds elapsed = std::chrono::steady_clock::now() - start;
  std::cout << elapsed.count() << ' ' << inliers.indices.size() << std::endl;
}

}  // namespace

int main() {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // only answers are printed
  std::cout << "ready" << std::endl;
  std::vector<Cloud::ConstPtr> scans;
  std::string word;
  std::size_t number = 0;
  while (std::cin >> word >> number) {
    std::cin.get();  // the end of the line
    if (word == "scan") {
      scans.push_back(read_cloud(number));
    } else {
      run(scans.at(number));
    }
  }
}
