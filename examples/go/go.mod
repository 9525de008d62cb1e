module segment_scan

go 1.19
