// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

//! Segment a scan in Rust, through the C interface.
//!
//!     rustc -O segment_scan.rs -C link-args="$(pkg-config --libs flagstone)"
//!     ./segment_scan                     an invented scan
//!     ./segment_scan SCAN.bin [LABELS]   a scan of 4 floats per point; writes its labels, 1 byte each

use std::ffi::{CStr, CString};
use std::{env, fs, process, ptr, slice};

/// The part of flagstone.h that this program uses.
mod c {
    use std::os::raw::{c_char, c_void};

    pub const ABI_VERSION: u32 = 1;
    pub const OK: i32 = 0;

    #[repr(C)]
    pub struct Segmenter {
        _private: [u8; 0],
    }
    #[repr(C)]
    pub struct Segmentation {
        _private: [u8; 0],
    }
    #[repr(C)]
    pub struct Error {
        pub message: [c_char; 512],
    }
    #[repr(C)]
    pub struct Cloud {
        pub data: *const c_void,
        pub count: usize,
        pub stride: isize,
        pub x: isize,
        pub y: isize,
        pub z: isize,
    }
    #[repr(C)]
    #[derive(Clone, Copy, Default)]
    pub struct GroundSample {
        pub height: f32,
        pub normal: [f32; 3],
        pub slope: f32,
        pub confidence: f32,
    }

    extern "C" {
        pub fn flagstone_abi_version() -> u32;
        pub fn flagstone_cloud_of_floats(points: *const f32, count: usize, floats: usize) -> Cloud;
        pub fn flagstone_segmenter_create(
            method: *const c_char,
            sensor_height: f32,
            segmenter: *mut *mut Segmenter,
            error: *mut Error,
        ) -> i32;
        pub fn flagstone_segmenter_destroy(segmenter: *mut Segmenter);
        pub fn flagstone_segmentation_create(
            segmentation: *mut *mut Segmentation,
            error: *mut Error,
        ) -> i32;
        pub fn flagstone_segmentation_destroy(segmentation: *mut Segmentation);
        pub fn flagstone_segment(
            segmenter: *mut Segmenter,
            cloud: Cloud,
            segmentation: *mut Segmentation,
            error: *mut Error,
        ) -> i32;
        pub fn flagstone_segmentation_size(segmentation: *const Segmentation) -> usize;
        pub fn flagstone_segmentation_labels(segmentation: *const Segmentation) -> *const u8;
        pub fn flagstone_segmentation_heights(segmentation: *const Segmentation) -> *const f32;
        pub fn flagstone_segmentation_sample_ground(
            segmentation: *const Segmentation,
            xy: *const f32,
            count: usize,
            samples: *mut GroundSample,
            error: *mut Error,
        ) -> i32;
    }
}

/// Label of ground points.
const GROUND: u8 = 1;

/// Calls a function that returns a status. Its message becomes the error.
fn checked(call: impl FnOnce(*mut c::Error) -> i32) -> Result<(), String> {
    let mut error = c::Error { message: [0; 512] };
    if call(&mut error) == c::OK {
        return Ok(());
    }
    // The message ends with a null character.
    let message = unsafe { CStr::from_ptr(error.message.as_ptr()) };
    Err(message.to_string_lossy().into_owned())
}

/// A segmenter and its result, freed when they go out of scope. Pointers are neither Send nor Sync,
/// so that the compiler keeps each pair in one thread.
struct Segmenter {
    segmenter: *mut c::Segmenter,
    segmentation: *mut c::Segmentation,
}

impl Segmenter {
    fn new(method: &str, sensor_height: f32) -> Result<Self, String> {
        if unsafe { c::flagstone_abi_version() } != c::ABI_VERSION {
            return Err("the library has another ABI version (expected 1)".to_string());
        }
        let method = CString::new(method).map_err(|error| error.to_string())?;
        let mut both = Segmenter {
            segmenter: ptr::null_mut(),
            segmentation: ptr::null_mut(),
        };
        checked(|error| unsafe {
            c::flagstone_segmenter_create(
                method.as_ptr(),
                sensor_height,
                &mut both.segmenter,
                error,
            )
        })?;
        checked(|error| unsafe {
            c::flagstone_segmentation_create(&mut both.segmentation, error)
        })?;
        Ok(both)
    }

    /// Segments points of 4 floats. The result borrows from this object: it is valid until the next
    /// scan.
    fn segment<'a>(&'a mut self, points: &[[f32; 4]]) -> Result<Scan<'a>, String> {
        checked(|error| unsafe {
            let cloud = c::flagstone_cloud_of_floats(points.as_ptr().cast(), points.len(), 4);
            c::flagstone_segment(self.segmenter, cloud, self.segmentation, error)
        })?;
        Ok(Scan {
            segmentation: self.segmentation,
            size: points.len(),
            owner: self,
        })
    }
}

impl Drop for Segmenter {
    fn drop(&mut self) {
        unsafe {
            c::flagstone_segmentation_destroy(self.segmentation);
            c::flagstone_segmenter_destroy(self.segmenter);
        }
    }
}

/// The result of one scan.
struct Scan<'a> {
    segmentation: *const c::Segmentation,
    size: usize,
    #[allow(dead_code)]
    owner: &'a Segmenter,
}

impl Scan<'_> {
    /// The label of each point.
    fn labels(&self) -> &[u8] {
        assert_eq!(self.size, unsafe {
            c::flagstone_segmentation_size(self.segmentation)
        });
        self.array(unsafe { c::flagstone_segmentation_labels(self.segmentation) })
    }

    /// The height of each point above the ground, metres; NaN if the ground is unknown.
    fn heights(&self) -> &[f32] {
        self.array(unsafe { c::flagstone_segmentation_heights(self.segmentation) })
    }

    /// The ground at a position.
    fn ground(&self, x: f32, y: f32) -> Result<c::GroundSample, String> {
        let mut sample = c::GroundSample::default();
        checked(|error| unsafe {
            let xy = [x, y];
            c::flagstone_segmentation_sample_ground(
                self.segmentation,
                xy.as_ptr(),
                1,
                &mut sample,
                error,
            )
        })?;
        Ok(sample)
    }

    fn array<T>(&self, values: *const T) -> &[T] {
        if values.is_null() {
            return &[];
        }
        unsafe { slice::from_raw_parts(values, self.size) }
    }
}

/// Ground that rises ahead of the sensor by 5 cm per metre, and a post 1.2 m high at x = 12, y = 3.
fn invented_scan() -> Vec<[f32; 4]> {
    let place = |i: usize| 0.25 * i as f32 - 30.0;
    let ground = |x: f32| x / 20.0 - 1.73;
    let mut points = Vec::new();
    for row in 0..241 {
        points.extend((0..241).map(|i| [place(i), place(row), ground(place(i)), 0.0]));
    }
    points.extend((0..25).map(|i| [12.0, 3.0, ground(12.0) + 0.05 * i as f32, 0.0]));
    points
}

fn read_scan(path: &str) -> Result<Vec<[f32; 4]>, String> {
    let bytes = fs::read(path).map_err(|error| format!("{}: {}", path, error))?;
    let float = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    Ok(bytes
        .chunks_exact(16)
        .map(|b| [float(b), float(&b[4..]), float(&b[8..]), float(&b[12..])])
        .collect())
}

fn run(arguments: &[String]) -> Result<(), String> {
    let points = match arguments.get(1) {
        Some(path) => read_scan(path)?,
        None => invented_scan(),
    };
    // Create it once, and use it for every scan.
    let mut segmenter = Segmenter::new("surface", 1.73)?;
    let scan = segmenter.segment(&points)?;

    let ground = scan
        .labels()
        .iter()
        .filter(|&&label| label == GROUND)
        .count();
    println!("ground: {} of {} points", ground, points.len());
    let highest = scan
        .heights()
        .iter()
        .fold(0.0f32, |most, &height| most.max(height));
    println!("highest point: {:.2} m above the ground", highest);
    let ahead = scan.ground(10.0, 0.0)?;
    if !ahead.height.is_nan() {
        println!(
            "ground 10 m ahead: z {:.2} m, slope {:.3} rad",
            ahead.height, ahead.slope
        );
    }
    if let Some(path) = arguments.get(2) {
        fs::write(path, scan.labels()).map_err(|error| format!("{}: {}", path, error))?;
    }
    Ok(())
}

fn main() {
    if let Err(message) = run(&env::args().collect::<Vec<_>>()) {
        eprintln!("segment_scan: {}", message);
        process::exit(1);
    }
}
