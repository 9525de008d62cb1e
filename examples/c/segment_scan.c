/* SPDX-FileCopyrightText: 2026 flagstone contributors */
/* SPDX-License-Identifier: MIT */

/* Segment a scan in C.
 *
 *   cc -std=c99 segment_scan.c -o segment_scan $(pkg-config --cflags --libs flagstone)
 *   ./segment_scan                     an invented scan
 *   ./segment_scan SCAN.bin [LABELS]   a scan of 4 floats per point; writes its labels, 1 byte each
 */

#include <flagstone/flagstone.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Every function that can fail returns a status and writes a message. */
static void check(flagstone_status status, const flagstone_error* error) {
  if (status == FLAGSTONE_OK) return;
  fprintf(stderr, "segment_scan: %s\n", error->message);
  exit(1);
}

static void fail(const char* path, const char* problem) {
  fprintf(stderr, "segment_scan: %s: %s\n", path, problem);
  exit(1);
}

/* Ground that rises ahead of the sensor by 5 cm per metre, and a post 1.2 m high at x = 12, y = 3.
 */
static float* invented_scan(size_t* count) {
  const size_t width = 241, post = 25;
  float* points = malloc((width * width + post) * 4 * sizeof(float));
  float* point = points;
  if (points == NULL) fail("memory", "exhausted");
  for (size_t i = 0; i < width * width + post; ++i, point += 4) {
    const int is_ground = i < width * width;
    point[0] = is_ground ? 0.25f * (float)(i % width) - 30 : 12;
    point[1] = is_ground ? 0.25f * (float)(i / width) - 30 : 3;
    point[2] = point[0] / 20 - 1.73f;
    if (!is_ground) point[2] += 0.05f * (float)(i - width * width);
    point[3] = 0; /* intensity */
  }
  *count = width * width + post;
  return points;
}

static float* read_scan(const char* path, size_t* count) {
  FILE* file = fopen(path, "rb");
  float* points = NULL;
  long size = -1;
  if (file == NULL) fail(path, "cannot be opened");
  if (fseek(file, 0, SEEK_END) == 0) size = ftell(file);
  if (size < 0) fail(path, "cannot be read");
  rewind(file);
  *count = (size_t)size / (4 * sizeof(float));
  points = malloc((size_t)size + 1);
  if (points == NULL) fail("memory", "exhausted");
  if (fread(points, 4 * sizeof(float), *count, file) != *count) fail(path, "cannot be read");
  fclose(file);
  return points;
}

static void write_labels(const char* path, const flagstone_label* labels, size_t count) {
  FILE* file = fopen(path, "wb");
  if (file == NULL) fail(path, "cannot be opened");
  if (fwrite(labels, 1, count, file) != count || fclose(file) != 0) fail(path, "cannot be written");
}

int main(int argc, char** argv) {
  flagstone_error error;
  flagstone_segmenter* segmenter = NULL;
  flagstone_segmentation* scan = NULL;
  size_t count = 0;
  float* points = argc > 1 ? read_scan(argv[1], &count) : invented_scan(&count);

  /* Create both once, and use them for every scan. Use one pair per thread. */
  check(flagstone_segmenter_create("surface", 1.73f, &segmenter, &error), &error);
  check(flagstone_segmentation_create(&scan, &error), &error);

  check(flagstone_segment(segmenter, flagstone_cloud_of_floats(points, count, 4), scan, &error),
        &error);
  printf("ground: %lu of %lu points\n",
         (unsigned long)flagstone_segmentation_label_count(scan, FLAGSTONE_GROUND),
         (unsigned long)count);

  /* The height of each point above the ground, metres; NaN if the ground is unknown. */
  const float* heights = flagstone_segmentation_heights(scan);
  float highest = 0;
  for (size_t i = 0; i < count; ++i) {
    if (heights[i] > highest) highest = heights[i];
  }
  printf("highest point: %.2f m above the ground\n", (double)highest);

  /* The ground at any position. */
  const float ahead[2] = {10, 0};
  flagstone_ground_sample ground;
  check(flagstone_segmentation_sample_ground(scan, ahead, 1, &ground, &error), &error);
  if (!isnan(ground.height)) {
    printf("ground 10 m ahead: z %.2f m, slope %.3f rad\n", (double)ground.height,
           (double)ground.slope);
  }

  if (argc > 2) write_labels(argv[2], flagstone_segmentation_labels(scan), count);
  flagstone_segmentation_destroy(scan);
  flagstone_segmenter_destroy(segmenter);
  free(points);
  return 0;
}
