# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Scan after scan with the same segmenter, and what Patchwork made of each patch of ground."""

import flagstone

frames = flagstone.simulate("simulated", scene="flat_street", frames=3)

# The segmenter keeps its memory: after the first scans hardly anything is allocated. Nothing else is kept, so that
# a scan's labels never depend on the scans before it.
segmenter = flagstone.Patchwork(sensor="hdl-64e")
for path in frames["scan"]:
    result = segmenter.segment(flagstone.io.read(path))
    print(f"ground: {result.counts['ground']} of {len(result)} points, {len(result.patches)} patches")

# The last scan's patches: where, how many points, the plane normal . p + d = 0, and why.
for patch in result.patches[:5]:
    x, y, z = patch["normal"]
    verdict = flagstone.Verdict(patch["verdict"]).name.lower()
    print(
        f"zone {patch['zone']} ring {patch['ring']} sector {patch['sector']:2}: {patch['point_count']:3} points,"
        f" normal ({x:.3f} {y:.3f} {z:.3f}), d {patch['d']:.2f}, {verdict}"
    )

# As a data frame they can be counted, grouped and joined.
print(result.to_pandas().groupby("verdict", observed=True)["point_count"].agg(["size", "sum"]))
