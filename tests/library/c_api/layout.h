/* SPDX-FileCopyrightText: 2026 flagstone contributors */
/* SPDX-License-Identifier: MIT */

/* The layout of every struct of flagstone.h with ABI version 1. A change of a number needs a new
 * FLAGSTONE_ABI_VERSION. */
#include "flagstone/flagstone.h"

/* Not compiled if `condition` is false. */
#define REQUIRE(name, condition) typedef char require_##name[(condition) ? 1 : -1]

REQUIRE(abi_version, FLAGSTONE_ABI_VERSION == 1);

REQUIRE(status, sizeof(flagstone_status) == 4);
REQUIRE(setting_type, sizeof(flagstone_setting_type) == 4);
REQUIRE(label, sizeof(flagstone_label) == 1);
REQUIRE(verdict, sizeof(flagstone_verdict) == 2);
REQUIRE(mount_verdict, sizeof(flagstone_mount_verdict) == 1);

REQUIRE(error, sizeof(flagstone_error) == 512);

REQUIRE(patch, sizeof(flagstone_patch) == 80);
REQUIRE(patch_verdict, offsetof(flagstone_patch, verdict) == 6);
REQUIRE(patch_point_count, offsetof(flagstone_patch, point_count) == 8);
REQUIRE(patch_mean, offsetof(flagstone_patch, mean) == 20);
REQUIRE(patch_d, offsetof(flagstone_patch, d) == 44);
REQUIRE(patch_eigenvalues, offsetof(flagstone_patch, eigenvalues) == 48);
REQUIRE(patch_surface_variable, offsetof(flagstone_patch, surface_variable) == 76);

REQUIRE(ground_sample, sizeof(flagstone_ground_sample) == 24);
REQUIRE(ground_sample_slope, offsetof(flagstone_ground_sample, slope) == 16);
REQUIRE(ground_sample_confidence, offsetof(flagstone_ground_sample, confidence) == 20);

REQUIRE(mount, sizeof(flagstone_mount) == 24);
REQUIRE(mount_confidence, offsetof(flagstone_mount, confidence) == 16);
REQUIRE(mount_verdict_offset, offsetof(flagstone_mount, verdict) == 20);

#if UINTPTR_MAX == 0xffffffffffffffff
REQUIRE(cloud, sizeof(flagstone_cloud) == 48);
REQUIRE(cloud_stride, offsetof(flagstone_cloud, stride) == 16);
REQUIRE(cloud_z, offsetof(flagstone_cloud, z) == 40);

REQUIRE(grid, sizeof(flagstone_grid) == 32);
REQUIRE(grid_width, offsetof(flagstone_grid, width) == 8);
REQUIRE(grid_confidences, offsetof(flagstone_grid, confidences) == 24);

REQUIRE(setting, sizeof(flagstone_setting) == 80);
REQUIRE(setting_type_offset, offsetof(flagstone_setting, type) == 24);
REQUIRE(setting_allows_infinity, offsetof(flagstone_setting, allows_infinity) == 29);
REQUIRE(setting_minimum, offsetof(flagstone_setting, minimum) == 32);
REQUIRE(setting_number, offsetof(flagstone_setting, number) == 48);
REQUIRE(setting_choice, offsetof(flagstone_setting, choice) == 72);
#endif
