/* SPDX-FileCopyrightText: 2026 flagstone contributors */
/* SPDX-License-Identifier: MIT */
#ifndef FLAGSTONE_FLAGSTONE_H
#define FLAGSTONE_FLAGSTONE_H

/**
 * @file
 * The C interface of flagstone, for C99, C++ and languages that call C functions. C++ programs can
 * use flagstone.hpp instead. Link the CMake target flagstone::flagstone, or use pkg-config.
 *
 * - Objects are handles. Functions whose name ends in `_create` or contains `_create_` make them,
 *   and the function whose name ends in `_destroy` frees them.
 * - Functions that can fail return a `flagstone_status` and write a message to the last argument,
 *   which can be NULL. If they fail, a handle to be created is NULL, and other output arguments
 *   are unchanged. Other functions return 0 or NULL for a null handle.
 * - No function throws, prints or ends the process.
 * - Text is UTF-8 and ends with a null character.
 * - Different handles can be used in different threads at once. A handle must not be used by two
 *   threads at once, unless all of them call functions that take it as a pointer to const.
 *   Functions without a handle are thread-safe.
 * - Lengths are in metres. Positions are in the sensor frame: x forward, y left, z up, origin at
 *   the sensor.
 */

#include <stdbool.h>  // NOLINT(modernize-deprecated-headers)
#include <stddef.h>   // NOLINT(modernize-deprecated-headers)
#include <stdint.h>   // NOLINT(modernize-deprecated-headers)

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Versions ------------------------------------------------------------------------------ */

/**
 * Version of the binary interface: functions, their arguments, constants and the layout of the
 * structs. It increases if one of them changes or is removed. New functions and constants do not
 * increase it. Programs that load the library at run time compare it with
 * flagstone_abi_version().
 */
#define FLAGSTONE_ABI_VERSION 1

/** FLAGSTONE_ABI_VERSION of the library that the program runs with. */
uint32_t flagstone_abi_version(void);

/** Version of the library that the program runs with, "major.minor.patch". Never freed. */
const char* flagstone_version(void);

/* ---- Errors -------------------------------------------------------------------------------- */

/** Outcome of a function: FLAGSTONE_OK or the kind of error. */
typedef int32_t flagstone_status;
/** Values of flagstone_status. */
enum {
  FLAGSTONE_OK = 0, /**< success */
  FLAGSTONE_INVALID_ARGUMENT =
      1,                         /**< an argument is invalid: a null handle, a value out of range */
  FLAGSTONE_OUT_OF_MEMORY = 2,   /**< memory could not be allocated */
  FLAGSTONE_INTERNAL_ERROR = 255 /**< any other error, such as a failure of the system */
};

/** The message of an error. */
typedef struct flagstone_error {
  /**
   * One line with the problem, the expected values and a hint. Longer messages are cut off. Empty
   * if the function succeeded.
   */
  char message[512];
} flagstone_error;

/* ---- Settings ------------------------------------------------------------------------------ */

/**
 * The settings of a method and of the mounting pose. They have the names that `flagstone config`
 * prints, such as "sensor_height", "point.margin" and "mount.tilt"; see
 * docs/reference/settings.md. Patchwork's zones have no setting: they follow from the preset or the
 * sensor. New versions can have more settings, which changes nothing in this interface.
 */
typedef struct flagstone_settings flagstone_settings;

/** Type of a setting. */
typedef int32_t flagstone_setting_type;
/** Values of flagstone_setting_type. */
enum {
  FLAGSTONE_NUMBER = 0,  /**< a number, stored as a 32-bit float */
  FLAGSTONE_INTEGER = 1, /**< an integer */
  FLAGSTONE_BOOLEAN = 2, /**< 0 or 1 */
  FLAGSTONE_NUMBERS = 3, /**< an array of numbers, stored as 32-bit floats */
  FLAGSTONE_CHOICE = 4   /**< one of a few names */
};

/** A setting: its name, its meaning, its range and its value. */
typedef struct flagstone_setting {
  const char* name;            /**< such as "point.margin" */
  const char* meaning;         /**< one sentence */
  const char* unit;            /**< such as "m"; empty for none */
  flagstone_setting_type type; /**< decides which of the values below is used */
  bool excludes_minimum;       /**< the value must be above `minimum` */
  bool allows_infinity;        /**< infinity is also allowed and means "no limit" */
  double minimum;              /**< smallest value of a number, or of each number of an array */
  double maximum;              /**< largest value of a number, or of each number of an array */
  double number;               /**< value of a number, an integer or a boolean; otherwise 0 */
  const float* numbers;        /**< values of an array; otherwise NULL */
  size_t number_count;         /**< number of values of an array; otherwise 0 */
  const char* choice;          /**< chosen name of a choice; otherwise NULL */
} flagstone_setting;

/** Number of methods. */
size_t flagstone_method_count(void);

/** Name of a method, such as "surface". NULL if `index` is not less than the number of methods. */
const char* flagstone_method_name(size_t index);

/**
 * Creates the default settings of a method: "surface" or "patchwork". Free them with
 * flagstone_settings_destroy().
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT if the method is unknown; FLAGSTONE_OUT_OF_MEMORY.
 */
flagstone_status flagstone_settings_create(const char* method, flagstone_settings** settings,
                                           flagstone_error* error);

/**
 * Creates the settings of a preset of "patchwork": "default", "paper" or "reference". The only
 * preset of other methods is "default".
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT if the method or the preset is unknown;
 * FLAGSTONE_OUT_OF_MEMORY.
 */
flagstone_status flagstone_settings_create_for_preset(const char* method, const char* preset,
                                                      flagstone_settings** settings,
                                                      flagstone_error* error);

/**
 * Creates the settings that follow from a known sensor, such as "hdl-64e", mounted
 * `sensor_height` above the ground. If `sensor_height` is NaN, it is the usual height of the
 * sensor.
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT if the method or the sensor is unknown, or the method cannot
 * derive settings for this height; FLAGSTONE_OUT_OF_MEMORY.
 */
flagstone_status flagstone_settings_create_for_sensor(const char* method, const char* sensor,
                                                      float sensor_height,
                                                      flagstone_settings** settings,
                                                      flagstone_error* error);

/** Frees settings. NULL is allowed. Segmenters that were created from them are not affected. */
void flagstone_settings_destroy(flagstone_settings* settings);

/** Number of settings. */
size_t flagstone_settings_count(const flagstone_settings* settings);

/**
 * Reads the setting with this index, which must be less than flagstone_settings_count(). Pointers
 * in `*setting` are valid until the settings change or are freed.
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT.
 */
flagstone_status flagstone_settings_at(const flagstone_settings* settings, size_t index,
                                       flagstone_setting* setting, flagstone_error* error);

/**
 * Reads the setting with this name; see flagstone_settings_at().
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT if the method has no such setting.
 */
flagstone_status flagstone_settings_find(const flagstone_settings* settings, const char* name,
                                         flagstone_setting* setting, flagstone_error* error);

/**
 * Name number `index` of those that a choice can have, in a fixed order. NULL if `name` is not a
 * choice, or `index` is not less than the number of names. Never freed.
 */
const char* flagstone_settings_choice(const flagstone_settings* settings, const char* name,
                                      size_t index);

/**
 * Sets a number, an integer or a boolean (0 or 1). The range is checked when a segmenter is
 * created.
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT if the method has no such setting, or the setting has another
 * type.
 */
flagstone_status flagstone_settings_set_number(flagstone_settings* settings, const char* name,
                                               double value, flagstone_error* error);

/**
 * Sets an array of numbers, such as "mount.up" (3 numbers). The values are copied. The range is
 * checked when a segmenter is created.
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT if the method has no such setting, or the setting has another
 * type or number of values; FLAGSTONE_OUT_OF_MEMORY.
 */
flagstone_status flagstone_settings_set_numbers(flagstone_settings* settings, const char* name,
                                                const float* values, size_t count,
                                                flagstone_error* error);

/**
 * Sets a choice, such as "mount.height" to "estimate".
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT if the method has no such setting, the setting has another
 * type, or `value` is not one of its names.
 */
flagstone_status flagstone_settings_set_choice(flagstone_settings* settings, const char* name,
                                               const char* value, flagstone_error* error);

/* ---- Results ------------------------------------------------------------------------------- */

/**
 * The class of a point. Every input point gets exactly one label. Label files contain these codes,
 * so the codes will not change.
 */
typedef uint8_t flagstone_label;
/** Values of flagstone_label. */
enum {
  FLAGSTONE_NONGROUND = 0, /**< on an object, above the ground, or in a patch that is not ground */
  FLAGSTONE_GROUND = 1,    /**< on the ground surface */
  FLAGSTONE_NOISE = 2,     /**< below any possible ground, such as ghost points from reflections */
  FLAGSTONE_OUT_OF_RANGE =
      3,                    /**< too far, too near, outside the field of view, or |z| above 10 km */
  FLAGSTONE_INVALID = 4,    /**< a coordinate is not finite, or all three are zero */
  FLAGSTONE_LABEL_COUNT = 5 /**< number of labels */
};

/** Name of a label, such as "out_of_range"; "unknown" for other codes. Never freed. */
const char* flagstone_label_name(flagstone_label label);

/** Whether a patch is ground, and the test that decided it. */
typedef uint16_t flagstone_verdict;
/** Values of flagstone_verdict. */
enum {
  FLAGSTONE_PATCH_GROUND = 0,         /**< ground: passed every test */
  FLAGSTONE_PATCH_GROUND_FLAT = 1,    /**< ground: too high, but flat enough to be accepted */
  FLAGSTONE_PATCH_TOO_FEW_POINTS = 2, /**< rejected: not enough points to fit a plane */
  FLAGSTONE_PATCH_NO_PLANE = 3,       /**< rejected: fewer than three points remained for the fit */
  FLAGSTONE_PATCH_NOT_UPRIGHT = 4,    /**< rejected: the normal is tilted too far */
  FLAGSTONE_PATCH_TOO_HIGH = 5,       /**< rejected: higher than ground can be at that range */
  FLAGSTONE_PATCH_MIXED = 6,          /**< rejected by "surface": too many points above the plane */
  FLAGSTONE_PATCH_OFF_SURFACE = 7     /**< rejected by "surface": too far from the other patches */
};

/** Name of a `flagstone_verdict`, such as "not_upright"; "unknown" for other codes. Never freed. */
const char* flagstone_verdict_name(flagstone_verdict verdict);

/**
 * A part of the x-y plane that contains points, with the plane fitted to it. If no plane was
 * fitted, its values are zero. patch.hpp describes the differences between the methods.
 */
typedef struct flagstone_patch {
  uint16_t zone;             /**< zone, 0 is the nearest to the sensor */
  uint16_t ring;             /**< ring within the zone; row of squares for "surface" */
  uint16_t sector;           /**< sector of the ring; column of squares for "surface" */
  flagstone_verdict verdict; /**< ground, or the reason for rejection */
  uint32_t point_count;      /**< number of points */
  uint32_t ground_count;     /**< number of points that are labelled ground */
  uint32_t
      lower_ground_count; /**< ground points that form a separate plane below, included above */
  float mean[3];          /**< mean of the ground points, metres */
  float normal[3];        /**< unit length, z >= 0 */
  float d;                /**< distance in normal . p + d = 0, metres */
  float eigenvalues[3];   /**< of the covariance, largest first, square metres */
  float uprightness;      /**< 1 if the patch is upright enough, otherwise 0 */
  float elevation;        /**< 0 to 1; low enough to be ground if above 0.5 */
  float flatness;         /**< 1, or the gain of a patch that is too high */
  float likelihood;       /**< product of the terms; ground if above 0.5 */
  float surface_variable; /**< smallest eigenvalue divided by the sum of all, 0 to 1/3 */
} flagstone_patch;

/**
 * The result of segmenting one scan. Use the same object for every scan: its buffers are reused, so
 * nothing is allocated after the first scans. Pointers into it are valid until it is used for the
 * next scan or freed.
 */
typedef struct flagstone_segmentation flagstone_segmentation;

/**
 * Creates an empty result. Free it with flagstone_segmentation_destroy().
 *
 * Errors: FLAGSTONE_OUT_OF_MEMORY; FLAGSTONE_INVALID_ARGUMENT for a null pointer.
 */
flagstone_status flagstone_segmentation_create(flagstone_segmentation** segmentation,
                                               flagstone_error* error);

/** Frees a result. NULL is allowed. */
void flagstone_segmentation_destroy(flagstone_segmentation* segmentation);

/** Number of points of the scan; 0 before the first scan and after an error. */
size_t flagstone_segmentation_size(const flagstone_segmentation* segmentation);

/**
 * The label of each point, in input order: flagstone_segmentation_size() values. NULL if there are
 * no points.
 */
const flagstone_label* flagstone_segmentation_labels(const flagstone_segmentation* segmentation);

/** Number of points with this label; 0 for unknown labels. */
size_t flagstone_segmentation_label_count(const flagstone_segmentation* segmentation,
                                          flagstone_label label);

/**
 * The height of each point above the ground, metres, in input order: flagstone_segmentation_size()
 * values. NaN if the height of the ground is unknown there, and for points that are invalid or out
 * of range. NULL if there are no points, and for "patchwork", which computes no heights.
 */
const float* flagstone_segmentation_heights(const flagstone_segmentation* segmentation);

/** Number of patches. */
size_t flagstone_segmentation_patch_count(const flagstone_segmentation* segmentation);

/**
 * The patches: flagstone_segmentation_patch_count() structs. "patchwork" orders them by zone, ring
 * and sector, "surface" by distance from the sensor. NULL if there are none.
 */
const flagstone_patch* flagstone_segmentation_patches(const flagstone_segmentation* segmentation);

/* ---- The ground surface -------------------------------------------------------------------- */

/** The ground at one position. */
typedef struct flagstone_ground_sample {
  float height;     /**< z of the ground, metres; NaN if unknown */
  float normal[3];  /**< unit length, z > 0; NaN if unknown */
  float slope;      /**< angle between normal and z axis, radians, 0 to pi/2; NaN if unknown */
  float confidence; /**< probability, 0 to 1, that the height is within 10 cm; 0 if unknown */
} flagstone_ground_sample;

/** A square grid of heights of the ground, centred on the sensor. */
typedef struct flagstone_grid {
  float cell;   /**< size of a cell, metres */
  size_t width; /**< number of cells along a side, even */
  /**
   * z of the ground at the centres of the cells, metres; NaN if unknown. width * width values, row
   * by row: y ascending, x ascending within a row. The centre of cell (row, column) is
   * x = (column + 0.5 - width / 2) * cell, y = (row + 0.5 - width / 2) * cell.
   */
  const float* heights;
  const float* confidences; /**< of each height; see flagstone_ground_sample */
} flagstone_grid;

/**
 * The ground at `count` positions. `xy` has x and y of each position, metres: 2 * count values.
 * They can have any value. `samples` has room for `count` structs. If the method computes no
 * surface, as "patchwork", every sample is unknown.
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT for null pointers.
 */
flagstone_status flagstone_segmentation_sample_ground(const flagstone_segmentation* segmentation,
                                                      const float* xy, size_t count,
                                                      flagstone_ground_sample* samples,
                                                      flagstone_error* error);

/**
 * The height of the ground at `count` positions, faster than
 * flagstone_segmentation_sample_ground(): z in metres, NaN if unknown. `heights` has room for
 * `count` values.
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT for null pointers.
 */
flagstone_status flagstone_segmentation_ground_heights(const flagstone_segmentation* segmentation,
                                                       const float* xy, size_t count,
                                                       float* heights, flagstone_error* error);

/** Number of grids of the ground surface; 0 if the method computes no surface. */
size_t flagstone_segmentation_grid_count(const flagstone_segmentation* segmentation);

/**
 * Reads a grid of the ground surface. The first grid is the coarsest and largest; each of the
 * others is inside the one before. `index` must be less than flagstone_segmentation_grid_count().
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT.
 */
flagstone_status flagstone_segmentation_grid(const flagstone_segmentation* segmentation,
                                             size_t index, flagstone_grid* grid,
                                             flagstone_error* error);

/* ---- Segmenters ---------------------------------------------------------------------------- */

/**
 * A point cloud in the memory of the caller. It is read without copying. The address of a
 * coordinate of point i, a 32-bit float with any alignment, is data + i * stride + offset, in
 * bytes. Offsets can exceed the stride: for N x values, then N y values, then N z values, the
 * stride is 4 and the offsets are 0, 4 * N and 8 * N.
 */
typedef struct flagstone_cloud {
  const void* data; /**< can be NULL if `count` is 0 */
  size_t count;     /**< number of points */
  ptrdiff_t stride; /**< distance between consecutive points, bytes */
  ptrdiff_t x;      /**< offset of x, bytes */
  ptrdiff_t y;      /**< offset of y, bytes */
  ptrdiff_t z;      /**< offset of z, bytes */
} flagstone_cloud;

/**
 * A cloud of `count` points with `floats_per_point` 32-bit floats each, starting with x, y and z: 3
 * for packed xyz, 4 for KITTI (x, y, z, intensity), 5 for nuScenes.
 */
flagstone_cloud flagstone_cloud_of_floats(const float* points, size_t count,
                                          size_t floats_per_point);

/**
 * A method with its settings and its working memory. It also corrects for a tilted sensor or an
 * unknown sensor height, if the settings "mount. ..." require it.
 */
typedef struct flagstone_segmenter flagstone_segmenter;

/**
 * Creates a segmenter with the default settings of a method, "surface" or "patchwork", for a sensor
 * `sensor_height` above the ground, metres, -100 to 100. It uses one thread. Free it with
 * flagstone_segmenter_destroy().
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT if the method is unknown or the height is out of range;
 * FLAGSTONE_OUT_OF_MEMORY.
 */
flagstone_status flagstone_segmenter_create(const char* method, float sensor_height,
                                            flagstone_segmenter** segmenter,
                                            flagstone_error* error);

/**
 * Creates a segmenter with other settings. `threads` is the number of threads that process one scan
 * together, 1 to 1,024, including the calling thread. The result does not depend on it.
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT naming the setting, its value and the allowed range, if a
 * value is out of range; FLAGSTONE_OUT_OF_MEMORY.
 */
flagstone_status flagstone_segmenter_create_with(const flagstone_settings* settings,
                                                 uint32_t threads, flagstone_segmenter** segmenter,
                                                 flagstone_error* error);

/** Frees a segmenter. NULL is allowed. Results are not affected. */
void flagstone_segmenter_destroy(flagstone_segmenter* segmenter);

/**
 * Labels every point of `cloud` and replaces the contents of `segmentation`. Coordinates can have
 * any value, including NaN and infinity. The memory of the cloud must not change during the call;
 * it is not used afterwards.
 *
 * The result is deterministic: the same cloud and settings give a bit-identical result, whatever
 * was segmented before, unless "mount.height" or "mount.tilt" is estimated from the scans. Memory
 * is allocated only until the buffers fit the largest scan.
 *
 * Errors: FLAGSTONE_OUT_OF_MEMORY; FLAGSTONE_INVALID_ARGUMENT if a handle is null, or the cloud has
 * a null pointer but points, or more than 2^32 - 1 points. `segmentation` is then empty.
 */
flagstone_status flagstone_segment(flagstone_segmenter* segmenter, flagstone_cloud cloud,
                                   flagstone_segmentation* segmentation, flagstone_error* error);

/* ---- Height and tilt of the sensor --------------------------------------------------------- */

/** Whether the estimate of the mounting pose from a scan was accepted, and if not, why. */
typedef uint8_t flagstone_mount_verdict;
/** Values of flagstone_mount_verdict. */
enum {
  FLAGSTONE_MOUNT_FIXED = 0,          /**< no estimate: the pose is configured or already known */
  FLAGSTONE_MOUNT_ACCEPTED = 1,       /**< the estimate is accepted */
  FLAGSTONE_MOUNT_TOO_FEW_POINTS = 2, /**< rejected: too few points where ground can be */
  FLAGSTONE_MOUNT_NO_PLANE = 3,       /**< rejected: near points do not fit one plane */
  FLAGSTONE_MOUNT_OBSTRUCTED = 4,     /**< rejected: the plane is at the base of obstacles */
  FLAGSTONE_MOUNT_POINTS_BELOW = 5,   /**< rejected: too many points below the plane */
  FLAGSTONE_MOUNT_ONE_SIDED = 6,      /**< rejected: ground is seen in too few directions */
  FLAGSTONE_MOUNT_HEIGHT_LIMIT = 7,   /**< rejected: the height is outside the limits */
  FLAGSTONE_MOUNT_TILT_LIMIT = 8,     /**< rejected: the tilt exceeds the limit */
  FLAGSTONE_MOUNT_OUTLIER = 9         /**< rejected: too far from the estimates of previous scans */
};

/** Name of a `flagstone_mount_verdict`, such as "points_below"; "unknown" for other codes. Never
 * freed. */
const char* flagstone_mount_verdict_name(flagstone_mount_verdict verdict);

/** Height and tilt of the sensor, and the estimate from the last scan. */
typedef struct flagstone_mount {
  float sensor_height;             /**< height above the ground along `up`, metres */
  float up[3];                     /**< up direction in the frame of the cloud, unit length */
  float confidence;                /**< of the estimate from the last scan, 0 to 1 */
  flagstone_mount_verdict verdict; /**< of the estimate from the last scan */
} flagstone_mount;

/**
 * Reads the mounting pose that was used for the last scan; before the first scan, the configured
 * one.
 *
 * Errors: FLAGSTONE_INVALID_ARGUMENT for null pointers.
 */
flagstone_status flagstone_segmenter_mount(const flagstone_segmenter* segmenter,
                                           flagstone_mount* mount, flagstone_error* error);

/**
 * Forgets the estimates from previous scans. Call it when another run begins. Without effect if
 * nothing is estimated. NULL is allowed.
 */
void flagstone_segmenter_reset(flagstone_segmenter* segmenter);

#ifdef __cplusplus
}
#endif

#endif /* FLAGSTONE_FLAGSTONE_H */
