//! The normal distribution without the platform's mathematics.

use core::f64::consts::FRAC_1_SQRT_2;

/// Probability below `z` deviations.
pub(super) fn probability(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// A numerator's or denominator's coefficients, from the highest power down.
type Polynomial = [f64; 8];

/// |p - 1/2| up to 0.425.
const MIDDLE: [Polynomial; 2] = [
    [
        2_509.080_928_730_122_7,
        33_430.575_583_588_13,
        67_265.770_927_008_7,
        45_921.953_931_549_87,
        13_731.693_765_509_46,
        1_971.590_950_306_551_3,
        133.141_667_891_784_38,
        3.387_132_872_796_366_5,
    ],
    [
        5_226.495_278_852_854,
        28_729.085_735_721_943,
        39_307.895_800_092_71,
        21_213.794_301_586_597,
        5_394.196_021_424_751,
        687.187_007_492_057_9,
        42.313_330_701_600_91,
        1.0,
    ],
];

/// Tails down to e^-25.
const TAIL: [Polynomial; 2] = [
    [
        7.745_450_142_783_414e-4,
        0.022_723_844_989_269_184,
        0.241_780_725_177_450_6,
        1.270_458_252_452_368_4,
        3.647_848_324_763_204_5,
        5.769_497_221_460_691,
        4.630_337_846_156_546,
        1.423_437_110_749_683_5,
    ],
    [
        1.050_750_071_644_416_9e-9,
        5.475_938_084_995_345e-4,
        0.015_198_666_563_616_457,
        0.148_103_976_427_480_08,
        0.689_767_334_985_1,
        1.676_384_830_183_803_8,
        2.053_191_626_637_759,
        1.0,
    ],
];

/// Tails beyond.
const FAR_TAIL: [Polynomial; 2] = [
    [
        2.010_334_399_292_288_1e-7,
        2.711_555_568_743_487_6e-5,
        0.001_242_660_947_388_078_4,
        0.026_532_189_526_576_124,
        0.296_560_571_828_504_87,
        1.784_826_539_917_291_3,
        5.463_784_911_164_114,
        6.657_904_643_501_103,
    ],
    [
        2.044_263_103_389_939_8e-15,
        1.421_511_758_316_446e-7,
        1.846_318_317_510_054_8e-5,
        7.868_691_311_456_133e-4,
        0.014_875_361_290_850_615,
        0.136_929_880_922_735_8,
        0.599_832_206_555_888,
        1.0,
    ],
];

/// How many deviations have probability `p` (0 to 1, neither included) below them: Wichura 1988, Applied
/// Statistics 37(3), algorithm AS 241, PPND16.
pub(super) fn quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(&MIDDLE, 0.180625 - q * q);
    }
    let r = (-libm::log(p.min(1.0 - p).max(f64::MIN_POSITIVE))).sqrt();
    let z = if r <= 5.0 {
        ratio(&TAIL, r - 1.6)
    } else {
        ratio(&FAR_TAIL, r - 5.0)
    };
    z.copysign(q)
}

fn ratio([above, below]: &[Polynomial; 2], x: f64) -> f64 {
    let value = |polynomial: &Polynomial| polynomial.iter().fold(0.0, |sum, &a| sum * x + a);
    value(above) / value(below)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The quantile is the inverse of the probability, in the middle and in both tails.
    #[test]
    fn quantile_inverts_probability() {
        for exponent in 1..=300 {
            let p = 10_f64.powi(-exponent);
            let back = probability(quantile(p));
            assert!((back / p - 1.0).abs() < 1e-12, "{p}: {back}");
        }
        for i in 1..1000 {
            let p = f64::from(i) / 1000.0;
            let back = probability(quantile(p));
            assert!((back - p).abs() < 1e-15, "{p}: {back}");
        }
        assert_eq!(quantile(0.5), 0.0);
        assert!(
            quantile(1.0).is_finite() && quantile(0.0).is_finite(),
            "ends"
        );
        assert!(
            (quantile(0.975) - 1.959_963_984_540_054).abs() < 1e-14,
            "two sigma"
        );
    }
}
