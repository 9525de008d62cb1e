# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Every setting that `Surface` and `Patchwork` take by name; written by scripts/python-settings.

Tables are dictionaries: `Surface(point={"margin": 0.2})`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypedDict


class Zone(TypedDict, total=False):
    """One zone Z_m of the Concentric Zone Model, section III-B; it begins where the one before it ends."""

    ring_radii: Sequence[float]
    """Outer radius of each ring, metres, ascending, up to 1,000; the last ends the zone."""
    sectors: int
    """N_theta: sectors a ring is cut into, 1 to 3,600."""
    height_margin: float
    """M_h: seeds are not chosen below M_h * h_s; below -1, -inf for no margin."""


class SurfaceAcceptance(TypedDict, total=False):
    """Table `acceptance` of `Surface`'s settings."""

    upright_angle: float
    """minimum angle between the normal of a ground patch and the x-y plane; 0 to 90 degrees."""
    max_clutter_ratio: float
    """a patch is not ground if the number of points just above its plane exceeds this multiple of the number of points
    in its plane; 0 to 1000, or inf for none.
    """
    max_height: float
    """maximum height of a ground patch above -h_s (max_slope * range applies if it is larger); 0 to 1000 m."""
    max_slope: float
    """maximum slope of the ground as seen from below the sensor: a ground patch may also be up to max_slope * range
    above -h_s; 0 to 10 m/m.
    """
    max_step: float
    """maximum height of a ground patch above the height predicted by nearer ground patches (0.5 m more is allowed below
    it); 0 to 100 m, or inf for none.
    """
    max_step_per_metre: float
    """increase of max_step per metre of distance to the nearest ground patch, up to 15 m; 0 to 10 m/m."""


class SurfaceRefinement(TypedDict, total=False):
    """Table `refinement` of `Surface`'s settings."""

    levels: int
    """number of levels that refine the surface, with cells of 2, 1, 0.5 and 0.25 m; 0 to 4."""
    gate: float
    """points at most this far above or below the surface correct it, in cells of 2 m; above 0, up to 10 m."""
    gate_factor: float
    """gate of each finer level, as a fraction of the gate of the level before; above 0, up to 1."""
    gate_per_metre: float
    """increase of the gate of every level per metre of range; 0 to 1 m/m."""
    max_clutter_ratio: float
    """a cell contains an obstacle if the number of points just above the surface exceeds this multiple of the number of
    points at the surface; 0 to 1000, or inf for none.
    """
    lower_bound_weight: float
    """weight of the lowest point of a cell that contains an obstacle, relative to a fully observed cell; 0 to 1."""


class SurfacePoint(TypedDict, total=False):
    """Table `point` of `Surface`'s settings."""

    margin: float
    """points lower than this above the surface are ground, in cells without an obstacle; 0 to 10 m."""
    obstacle_margin: float
    """points lower than this above the surface are ground, in cells that contain an obstacle; 0 to 10 m."""
    obstacle_height: float
    """obstacle height above the surface: a cell with a point above 1.25 times this value uses obstacle_margin, above
    0.75 times the mean of both margins; 0 to 2 m.
    """
    noise_depth: float
    """points farther than this below the surface are noise, unless they form a separate plane; 0 to 1000 m."""
    noise_depth_per_metre: float
    """increase of point.noise_depth per metre of range; 0 to 10 m/m."""


class SurfaceSettings(TypedDict, total=False):
    """Settings of `Surface` by name."""

    max_range: float
    """points at this horizontal range or beyond are out of range; 8 to 200 m."""
    noise_depth: float
    """points lower than -h_s - noise_depth - noise_slope * range are noise; 0 to 1000 m."""
    noise_slope: float
    """maximum downward slope of the ground: the noise limit (see noise_depth) is lower by this much per metre of range;
    0 to 10 m/m.
    """
    acceptance: SurfaceAcceptance
    refinement: SurfaceRefinement
    point: SurfacePoint
    mount: Mapping[str, object]
    """How the sensor stands, where more is to be said than its height and tilt: docs/explanation/sensor-height-and-tilt.md."""


class PatchworkFieldOfView(TypedDict, total=False):
    """Table `field_of_view` of `Patchwork`'s settings."""

    begin: float
    """where sector 0 begins, counter-clockwise from x; -360 to 360 degrees."""
    width: float
    """how far the zones go from there; points outside are out of range; above 0, up to 360 degrees."""


class PatchworkUprightness(TypedDict, total=False):
    """Table `uprightness` of `Patchwork`'s settings."""

    enabled: bool
    """phi, eq. (9)."""
    angle: float
    """theta_tau: smallest angle between normal and x-y plane; 0 to 90 degrees."""


class PatchworkElevation(TypedDict, total=False):
    """Table `elevation` of `Patchwork`'s settings."""

    enabled: bool
    """psi, eq. (10)."""
    base: float
    """kappa(r) = -h_s + base * exp(growth * r); 0 to 100 m."""
    growth: float
    """of kappa; 0 to 1 per m."""
    range: float
    """L_tau: bins centred beyond are not judged by elevation; 0 to 1000 m."""
    scale: float
    """width of the step; 1 is the paper's formula; above 0, up to 1000 m."""


class PatchworkFlatness(TypedDict, total=False):
    """Table `flatness` of `Patchwork`'s settings."""

    enabled: bool
    """varphi, eq. (11)."""
    gain: float
    """zeta; above 1, up to 1000."""
    thresholds: Sequence[float]
    """sigma_tau of each ring, the last one for all beyond; 0 to 0.333333."""
    scale: float
    """width of the step, units of sigma; 1 is the paper's formula; above 0, up to 1000."""


class PatchworkSettings(TypedDict, total=False):
    """Settings of `Patchwork` by name."""

    min_range: float
    """L_min: nearer points are out of range; 0 to 1000 m."""
    noise_depth: float
    """points lower than -h_s - noise_depth - noise_slope * r are noise; 0 to 1000 m, or inf for none."""
    noise_slope: float
    """steepest descent of ground still believed; 0 to 10 m/m."""
    min_points: int
    """bins with fewer points are not fitted; 3 to 1000000."""
    sparse_bins_are_ground: bool
    """what the points of such bins are."""
    seed_count: int
    """N_seed: lowest points that start the fit; 1 to 1000."""
    seed_height: float
    """z_seed, eq. (5); above 0, up to 100 m."""
    keep_below_margin: bool
    """whether points below a zone's height margin may enter the first ground set."""
    distance_margin: float
    """M_d, eq. (6); above 0, up to 100 m."""
    noise_margin: float
    """points farther below the plane are no part of it but noise; above 0, up to 1000 m, or inf for none."""
    lower_plane_margin: float
    """points farther below a ground plane are ground in a plane of their own, else noise; above 0, up to 1000 m, or inf
    for none.
    """
    iterations: int
    """plane fits a bin; 1 to 100."""
    evaluate_final_set: bool
    """whether the likelihood judges the final ground set (paper) or the last fitted one (public code)."""
    field_of_view: PatchworkFieldOfView
    uprightness: PatchworkUprightness
    elevation: PatchworkElevation
    flatness: PatchworkFlatness
    zones: Sequence[Zone]
    """Z_1, Z_2, ... from the sensor outward, 1 to 16."""
    mount: Mapping[str, object]
    """How the sensor stands, where more is to be said than its height and tilt: docs/explanation/sensor-height-and-tilt.md."""
