//! A search for jumps.
//!
//! A walk is sampled, then its steepest steps are halved again and again, always towards the steeper half:
//! whatever difference is left over no distance is a jump.

/// The largest jump of `f` over 0 to 1 and where, relative to its largest value.
pub(crate) fn largest_jump(f: impl Fn(f64) -> f64) -> (f64, f64) {
    const STEPS: u32 = 2000;
    let place = |i: u32| f64::from(i) / f64::from(STEPS);
    let values: Vec<f64> = (0..=STEPS).map(|i| f(place(i))).collect();
    let most = values.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let mut steps: Vec<u32> = (0..STEPS).collect();
    let rise = |i: u32| (values[i as usize + 1] - values[i as usize]).abs();
    steps.sort_by(|&a, &b| rise(b).total_cmp(&rise(a)));
    let mut jump = (0.0, 0.0);
    for &i in &steps[..60] {
        let (mut a, mut b) = (place(i), place(i + 1));
        let (mut at_a, mut at_b) = (values[i as usize], values[i as usize + 1]);
        for _ in 0..34 {
            let middle = 0.5 * (a + b);
            let value = f(middle);
            if (value - at_a).abs() > (at_b - value).abs() {
                (b, at_b) = (middle, value);
            } else {
                (a, at_a) = (middle, value);
            }
        }
        let left = (at_b - at_a).abs() / most;
        if left > jump.0 {
            jump = (left, a);
        }
    }
    jump
}

/// What a jump may be: the noise of single precision.
pub(crate) const NOISE: f64 = 2e-4;

/// What a jump may be where scratches grow too many to be told apart, and their aggregate takes over: a quarter
/// of what an eye sees.
pub(crate) const CROWD: f64 = 5e-3;

pub(crate) fn assert_smooth(name: &str, f: impl Fn(f64) -> f64) {
    assert_jumps_below(NOISE, name, f);
}

pub(crate) fn assert_jumps_below(limit: f64, name: &str, f: impl Fn(f64) -> f64) {
    let (jump, at) = largest_jump(f);
    println!("{name}: largest jump {jump:.1e} at {at}");
    assert!(jump < limit, "{name} jumps by {jump} at {at}");
}
