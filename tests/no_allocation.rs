//! Nothing allocates once a pattern is built: not shading, not evaluating, not asking for scratches, not
//! being refused.

#[path = "support/hosts.rs"]
mod hosts;
mod support;

use hosts::{Matt, Satin, hosted};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::fmt::Write;
use std::hint::black_box;
use striae::brdf::{Lobe, Metal};
use striae::formation::{Layer, Material, Tool};
use striae::pattern::{Footprint, Frame, Key, Path, Pattern, Scratch, ScratchHit, SurfacePoint};
use striae::scattering::{Bounces, CrossFootprint, Output, SeenZone, Shading, Vectors};
use support::crowd::add;
use support::{SHEET_MM, direction, ggx, sheet_of};

/// Counts this thread's allocations.
struct Counting;

thread_local! {
    /// Const-initialised and without a destructor: to reach it allocates nothing.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    // A thread that is being torn down has nothing left to count.
    let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
}

#[expect(unsafe_code, reason = "an allocator is unsafe by its trait")]
// SAFETY: every call goes to the system's allocator unchanged; counting neither allocates nor unwinds.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller's own promises.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller's own promises.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: the caller's own promises.
        unsafe { System.realloc(block, layout, size) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        count();
        // SAFETY: the caller's own promises.
        unsafe { System.dealloc(block, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How often `what` went to the allocator on this thread (to free counts, too).
fn allocations<R>(what: impl FnOnce() -> R) -> u64 {
    let before = ALLOCATIONS.with(Cell::get);
    black_box(what());
    ALLOCATIONS.with(Cell::get) - before
}

/// Straight, curved, crossing, ending and crowded scratches with several materials, one of the host's own.
fn pattern() -> Pattern {
    let titanium = Material::metal(Metal::Titanium);
    let polished = Material::new(100.0, ggx(0.1, 0.5), ggx(0.005, 0.9));
    let albedo = [0.8, 0.5, 0.2];
    let alphas = [0.2, 0.1];
    let eta_k = None;
    let own = Material {
        layers: vec![Layer {
            thickness_mm: 0.002,
            scratched: hosted(Matt { albedo }),
        }],
        ..Material::new(100.0, ggx(0.1, 0.5), hosted(Satin { alphas, eta_k }))
    };
    let mut builder = sheet_of(&titanium);
    for i in 0..200 {
        let material = [Some(&polished), Some(&own), None][i as usize % 3];
        let i = f64::from(i);
        let tool = Tool::rockwell_c();
        add(
            &mut builder,
            &tool,
            material,
            0.3 * i - 30.0,
            7.0 * i,
            0.1 + 0.01 * i,
        );
    }
    let nail = Tool::nail();
    for path in [
        Path::CubicBezier(&[[0.45, 0.45], [0.6, 0.4], [0.4, 0.6], [0.55, 0.55]]),
        Path::Polyline(&[[0.49, 0.5], [0.5, 0.5], [0.495, 0.504]]),
    ] {
        let keys = [
            Key::force(0.0, 0.0),
            Key::force(0.5, 3.0),
            Key::force(1.0, 0.0),
        ];
        let scratch = Scratch {
            path,
            keys: &keys,
            ..Scratch::new(&nail)
        };
        builder.add(&scratch).unwrap();
    }
    builder.build()
}

/// Text that goes nowhere.
struct Nowhere;

impl Write for Nowhere {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        black_box(text);
        Ok(())
    }
}

/// Every question to a prepared point but what it reflects, with one bounce and with all.
fn sampled(shading: &Shading, light: [f32; 3]) -> f32 {
    let mut sum = shading.pdf(light) + shading.pdf_reverse(light) + shading.eval_pdf(light).pdf;
    let mut zones = [SeenZone::default(); 4];
    sum += if shading.zones(light, &mut zones) > 4 {
        1.0
    } else {
        0.0
    };
    let told = shading.parameters();
    black_box((told, shading.zone_brdf(1), shading.has_lobe(Lobe::Glossy)));
    let mut shading = *shading;
    for bounces in [Bounces::One, Bounces::All] {
        shading.set_bounces(bounces);
        sum += shading
            .sample([0.3, 0.6, 0.9])
            .map_or(0.0, |sample| sample.pdf);
        let [x, y, z] = light.map(|component| [component; 9]);
        let many = Vectors {
            x: &x,
            y: &y,
            z: &z,
            stride: 1,
        };
        let evaluated = shading.eval_pdf_many(&many, 9, |_, one| sum += one.pdf);
        let chosen = shading.sample_many(&many, 9, |_, one| sum += one.map_or(0.0, |one| one.pdf));
        let refused = shading.eval_many(&many, 10, Output::Brdf, |_, rgb| sum += rgb[0]);
        let told = evaluated.is_ok() && chosen.is_ok();
        assert!(told && refused.is_err(), "{refused:?}");
    }
    sum + shading.eval(light, Output::Brdf)[0] + shading.roughness()
}

/// Every public call of render time, good and refused.
fn render(pattern: &Pattern) -> f32 {
    let mut shading = Shading::default();
    let (mut sum, mut covered, mut refused, mut told) = (0.0, 0, 0, 0);
    let footprints = [
        Footprint::Point,
        Footprint::Radius(0.001),
        Footprint::Radius(0.5),
        Footprint::Radius(200.0),
        Footprint::Radius(f32::NAN),
        Footprint::Radius(-1.0),
        Footprint::Differentials {
            duv_dx: [1e-5, 3e-6],
            duv_dy: [-4e-6, 2e-5],
        },
        Footprint::Differentials {
            duv_dx: [0.3, 0.3],
            duv_dy: [0.3, 0.3],
        },
        Footprint::Differentials {
            duv_dx: [f32::INFINITY, 0.0],
            duv_dy: [0.0, 1.0],
        },
    ];
    let views = [
        [0.0, 0.0, 1.0],
        direction(80.0, 30.0),
        direction(89.99, 200.0),
        [0.1, 0.1, -1.0],
        [0.0, 0.0, 0.0],
        [f32::NAN, 0.0, 1.0],
    ];
    let size = support::single(SHEET_MM);
    let frames = [
        ([size, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, 1.0]),
        ([0.0, size, 1.0], [size, 0.2, 0.0], [0.3, 0.0, 2.0]),
        ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ([size, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, 0.0]),
        ([f32::NAN, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, 1.0]),
    ];
    for uv in [
        [0.5, 0.5],
        [0.495, 0.5002],
        [0.0, 1.0],
        [7.0, -3.0],
        [f64::NAN, 0.5],
    ] {
        for (footprint, (dp_du, dp_dv, normal)) in footprints
            .into_iter()
            .flat_map(|footprint| frames.map(|frame| (footprint, frame)))
        {
            let point = SurfacePoint {
                uv,
                dp_du,
                dp_dv,
                normal,
                footprint,
            };
            if let Ok(frame) = Frame::at(&point) {
                sum += frame.to_world(frame.to_local(frame.x)).x;
            }
            let mut hits = [ScratchHit::default(); 4];
            match pattern.hits(&point, &mut hits) {
                Ok(found) => told += found.count,
                Err(error) => write!(Nowhere, "{error}").unwrap(),
            }
            for view in views {
                black_box(pattern.is_near(&point, Some(view)));
                if let Err(error) = shading.shade(pattern, &point, view) {
                    // To say what was wrong costs nothing either.
                    write!(Nowhere, "{error}").unwrap();
                    refused += 1;
                }
                for light in views {
                    sum += shading.eval(light, Output::Brdf)[0];
                    sum += shading.eval(light, Output::BrdfCos)[2];
                    sum += sampled(&shading, light);
                }
                covered += u32::from(shading.coverage() > 0.0);
            }
        }
    }
    let section = [[-0.1, 0.0], [0.0, -0.02], [0.1, 0.0]];
    for (points, pixel) in [
        (&section[..], CrossFootprint::Whole { margin_mm: 0.1 }),
        (
            &section[..],
            CrossFootprint::Box {
                center_mm: 0.01,
                extents_mm: [0.03, 0.1],
            },
        ),
        (&section[..1], CrossFootprint::Whole { margin_mm: 0.1 }),
    ] {
        sum += shading.albedo()[0];
        let [zone, flat] = [ggx(0.1, 0.5), ggx(7.0, 0.5)];
        for surface in [zone, flat] {
            let shaded =
                shading.shade_cross_section(points, &zone, &surface, pixel, direction(40.0, 9.0));
            sum += if shaded.is_ok() { 1.0 } else { 0.0 };
            sum += shading.eval(direction(30.0, 9.0), Output::Brdf)[1];
        }
    }
    assert!(
        sum > 0.0 && covered > 100 && refused > 100 && told > 100,
        "nothing was rendered"
    );
    sum
}

/// Shading and evaluating, on this thread, from the very first call.
#[test]
fn rendering_allocates_nothing() {
    let pattern = pattern();
    assert_eq!(allocations(|| render(&pattern)), 0, "the first time");
    assert_eq!(allocations(|| render(&pattern)), 0, "the second time");
}

/// The same on threads that have never called anything of the crate: no per-thread setup, no locks' memory.
#[test]
fn fresh_threads_allocate_nothing() {
    let pattern = pattern();
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4)
            .map(|_| scope.spawn(|| allocations(|| render(&pattern))))
            .collect();
        for thread in threads {
            assert_eq!(thread.join().unwrap(), 0, "on a fresh thread");
        }
    });
}

/// Nor do the earlier systems allocate, once their images and lists are made.
#[cfg(feature = "files")]
#[test]
fn earlier_systems_allocate_nothing() {
    use striae::baseline::{Baseline, Canvas, Highlight, TwoAngles};
    let pattern = pattern();
    let canvas = Canvas {
        area_uv: [[0.0; 2], [1.0; 2]],
        texels: [256; 2],
    };
    let highlight = Highlight {
        specular: [0.5; 3],
        exponent: 20.0,
    };
    let scratch = TwoAngles {
        width_mm: 0.2,
        peak_deg: 20.0,
        groove_deg: 40.0,
        zones: [ggx(0.2, 0.8); 4],
    };
    let systems = [
        Baseline::bb90(&pattern, &canvas, [0.2, 0.8], 1),
        Baseline::bl99(&pattern, &canvas, &highlight),
        Baseline::mdg01(&pattern, &canvas, &scratch),
    ];
    for system in systems.map(Result::unwrap) {
        let mut scratched = 0;
        let count = allocations(|| {
            let mut shading = Shading::default();
            for i in 0..2000 {
                let [u, v] = [0.7548777, 0.5698403].map(|s| (f64::from(i) * s).fract());
                let point = SurfacePoint {
                    uv: [u, v],
                    dp_du: [100.0, 0.0, 0.0],
                    dp_dv: [0.0, 100.0, 0.0],
                    normal: [0.0, 0.0, 1.0],
                    footprint: Footprint::Radius(0.5),
                };
                let shaded = system.shade(&point, [0.2, 0.1, 0.9], &mut shading);
                black_box((
                    shaded.is_ok(),
                    shading.eval([0.1, 0.3, 0.9], Output::BrdfCos),
                ));
                scratched += shading.scratch_count();
            }
        });
        assert!(scratched > 0, "nothing was shaded");
        assert_eq!(count, 0, "{scratched} scratched points");
    }
}

/// Copying a shading point and making one allocate nothing: it is plain data.
#[test]
fn shading_points_are_plain() {
    let count = allocations(|| {
        let shading = black_box(Shading::default());
        let copy = black_box(shading);
        black_box((shading, copy));
    });
    assert_eq!(count, 0, "to make and to copy");
}

/// The allocator counts: what allocates, what frees, and building, but not another thread's.
#[test]
fn allocations_are_counted() {
    assert_eq!(
        allocations(|| black_box(Box::new(7))),
        2,
        "a box made and dropped"
    );
    assert!(
        allocations(|| black_box(vec![0_u8; 100]).push(1)) >= 3,
        "a vector grown"
    );
    assert!(allocations(pattern) > 100, "a pattern built");
    let (sender, receiver) = std::sync::mpsc::channel::<()>();
    let other = std::thread::spawn(move || {
        receiver.recv().unwrap();
        black_box(vec![1_u8; 1000]);
    });
    let quiet = allocations(|| sender.send(()).is_ok());
    assert!(quiet <= 2, "another thread's count here: {quiet}");
    other.join().unwrap();
}
