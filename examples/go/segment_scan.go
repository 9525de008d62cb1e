// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// Segment a scan in Go, through the C interface.
//
//	go build
//	./segment_scan                     an invented scan
//	./segment_scan SCAN.bin [LABELS]   a scan of 4 floats per point; writes its labels, 1 byte each
package main

// #cgo pkg-config: flagstone
// #include <flagstone/flagstone.h>
// #include <stdlib.h>
import "C"

import (
	"encoding/binary"
	"errors"
	"fmt"
	"math"
	"os"
	"unsafe"
)

// Label of ground points.
const ground = C.FLAGSTONE_GROUND

// A Segmenter and its result. Use one per goroutine, and Close it.
type Segmenter struct {
	segmenter    *C.flagstone_segmenter
	segmentation *C.flagstone_segmentation
}

// The message of a function that returned a status.
func failure(status C.flagstone_status, message *C.flagstone_error) error {
	if status == C.FLAGSTONE_OK {
		return nil
	}
	return errors.New(C.GoString(&message.message[0]))
}

// NewSegmenter creates a segmenter for a sensor at this height above the ground, metres.
func NewSegmenter(method string, sensorHeight float32) (*Segmenter, error) {
	var message C.flagstone_error
	name := C.CString(method)
	defer C.free(unsafe.Pointer(name))
	both := &Segmenter{}
	err := failure(C.flagstone_segmenter_create(name, C.float(sensorHeight), &both.segmenter, &message), &message)
	if err == nil {
		err = failure(C.flagstone_segmentation_create(&both.segmentation, &message), &message)
	}
	if err != nil {
		both.Close()
		return nil, err
	}
	return both, nil
}

// Close frees the memory.
func (s *Segmenter) Close() {
	C.flagstone_segmentation_destroy(s.segmentation)
	C.flagstone_segmenter_destroy(s.segmenter)
}

// Segment segments points of 4 floats. Labels and heights are valid until the next call and until Close.
func (s *Segmenter) Segment(points [][4]float32) (labels []uint8, heights []float32, err error) {
	var message C.flagstone_error
	var first *C.float
	if len(points) > 0 {
		first = (*C.float)(&points[0][0])
	}
	cloud := C.flagstone_cloud_of_floats(first, C.size_t(len(points)), 4)
	if err := failure(C.flagstone_segment(s.segmenter, cloud, s.segmentation, &message), &message); err != nil {
		return nil, nil, err
	}
	size := int(C.flagstone_segmentation_size(s.segmentation))
	labels = unsafe.Slice((*uint8)(C.flagstone_segmentation_labels(s.segmentation)), size)
	if first := C.flagstone_segmentation_heights(s.segmentation); first != nil { // "patchwork" has none
		heights = unsafe.Slice((*float32)(first), size)
	}
	return labels, heights, nil
}

// Ground returns the height of the ground at a position, metres, and its slope, radians.
func (s *Segmenter) Ground(x, y float32) (height, slope float32, err error) {
	var message C.flagstone_error
	var sample C.flagstone_ground_sample
	xy := [2]C.float{C.float(x), C.float(y)}
	err = failure(C.flagstone_segmentation_sample_ground(s.segmentation, &xy[0], 1, &sample, &message), &message)
	return float32(sample.height), float32(sample.slope), err
}

// Ground that rises ahead of the sensor by 5 cm per metre, and a post 1.2 m high at x = 12, y = 3.
func inventedScan() [][4]float32 {
	var points [][4]float32
	for row := 0; row < 241; row++ {
		for i := 0; i < 241; i++ {
			x := 0.25*float32(i) - 30
			points = append(points, [4]float32{x, 0.25*float32(row) - 30, float32(x/20) - 1.73, 0})
		}
	}
	for i := 0; i < 25; i++ {
		base := float32(12.0)/20 - 1.73
		points = append(points, [4]float32{12, 3, base + float32(0.05*float32(i)), 0})
	}
	return points
}

func readScan(path string) ([][4]float32, error) {
	bytes, err := os.ReadFile(path)
	if err != nil {
		return nil, err
	}
	points := make([][4]float32, len(bytes)/16)
	for i := range points {
		for k := range points[i] {
			points[i][k] = math.Float32frombits(binary.LittleEndian.Uint32(bytes[16*i+4*k:]))
		}
	}
	return points, nil
}

func run(arguments []string) error {
	points := inventedScan()
	if len(arguments) > 1 {
		var err error
		if points, err = readScan(arguments[1]); err != nil {
			return err
		}
	}
	// Create it once, and use it for every scan.
	segmenter, err := NewSegmenter("surface", 1.73)
	if err != nil {
		return err
	}
	defer segmenter.Close()
	labels, heights, err := segmenter.Segment(points)
	if err != nil {
		return err
	}

	count := 0
	for _, label := range labels {
		if label == ground {
			count++
		}
	}
	fmt.Printf("ground: %d of %d points\n", count, len(points))
	var highest float32
	for _, height := range heights {
		if height > highest {
			highest = height
		}
	}
	fmt.Printf("highest point: %.2f m above the ground\n", highest)
	height, slope, err := segmenter.Ground(10, 0)
	if err != nil {
		return err
	}
	if !math.IsNaN(float64(height)) {
		fmt.Printf("ground 10 m ahead: z %.2f m, slope %.3f rad\n", height, slope)
	}
	if len(arguments) > 2 {
		return os.WriteFile(arguments[2], labels, 0o666)
	}
	return nil
}

func main() {
	if err := run(os.Args); err != nil {
		fmt.Fprintln(os.Stderr, "segment_scan:", err)
		os.Exit(1)
	}
}
