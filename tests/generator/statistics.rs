//! Distributions by their textbook formulas, and whether values follow them.

use core::f64::consts::FRAC_1_SQRT_2;
use striae::pattern::Distribution;

pub(crate) fn normal_below(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Kolmogorov's test: how far the values' own distribution is from `below` stays under what chance exceeds once in
/// ten thousand.
pub(crate) fn assert_distributed(what: &str, mut values: Vec<f64>, below: impl Fn(f64) -> f64) {
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    let farthest = values
        .iter()
        .enumerate()
        .map(|(i, &value)| {
            let p = below(value);
            (p - i as f64 / count)
                .abs()
                .max(((i + 1) as f64 / count - p).abs())
        })
        .fold(0.0, f64::max);
    let limit = (0.5 * (2.0 / 1e-4_f64).ln()).sqrt() / count.sqrt();
    assert!(
        farthest < limit,
        "{what}: {farthest} from its distribution, limit {limit}, {count} values"
    );
}

pub(crate) fn correlation(pairs: &[[f64; 2]]) -> f64 {
    let count = pairs.len() as f64;
    let mean = |k: usize| pairs.iter().map(|pair| pair[k]).sum::<f64>() / count;
    let (a, b) = (mean(0), mean(1));
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| pairs.iter().map(f).sum::<f64>();
    sum(&|p| (p[0] - a) * (p[1] - b))
        / (sum(&|p| (p[0] - a).powi(2)) * sum(&|p| (p[1] - b).powi(2))).sqrt()
}

/// Probability below a value.
pub(crate) type Below = Box<dyn Fn(f64) -> f64>;

/// Every distribution, and the probability below a value by its textbook formula, cut to its ends.
pub(crate) fn distributions() -> Vec<(&'static str, Distribution, Below)> {
    let (from, to) = (0.5, 20.0);
    let cut = |below: Below| -> Below {
        Box::new(move |x| (below(x) - below(from)) / (below(to) - below(from)))
    };
    let normal = Distribution::Normal {
        from,
        to,
        middle: 4.0,
        deviation: 5.0,
    };
    let log_normal = Distribution::LogNormal {
        from,
        to,
        middle: 3.0,
        deviation: 0.8,
    };
    let power = |exponent| Distribution::PowerLaw { from, to, exponent };
    let exponential = Distribution::Exponential {
        from,
        to,
        decay: 3.0,
    };
    vec![
        (
            "uniform",
            Distribution::Uniform { from, to },
            cut(Box::new(|x| x)),
        ),
        (
            "normal",
            normal,
            cut(Box::new(|x| normal_below((x - 4.0) / 5.0))),
        ),
        (
            "log-normal",
            log_normal,
            cut(Box::new(|x| normal_below((x / 3.0).ln() / 0.8))),
        ),
        (
            "power law 2.5",
            power(2.5),
            cut(Box::new(|x| -x.powf(-1.5))),
        ),
        ("power law 1", power(1.0), cut(Box::new(f64::ln))),
        ("power law -1", power(-1.0), cut(Box::new(|x| x * x))),
        (
            "exponential",
            exponential,
            cut(Box::new(|x| -(-x / 3.0).exp())),
        ),
    ]
}
