// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// PCL's plane RANSAC as a worker of `flagstone bench --compare`; bench/external_worker.py says how they
// talk. The threshold is that of flagstone's own RANSAC, 0.2 m; 1,000 trials at most; the rest are
// PCL's defaults.
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

/// The points that have a place.
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

/// Prints the nanoseconds it took and how many points lie on the plane.
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
  const std::chrono::nanoseconds spent = std::chrono::steady_clock::now() - start;
  std::cout << spent.count() << ' ' << inliers.indices.size() << std::endl;
}

}  // namespace

int main() {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // nothing but answers is printed
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
