use super::*;
use proptest::prelude::*;

/// Everything that bounds aspects of robots without bodies.
fn formula<T: Scalar>(x: T, y: T) -> T {
    let (s, c) = (x * y).sin_cos();
    let three = T::constant(Interval::point(3.0));
    (x.square() - y * s).sqrt() / (c + three) - (x * c).scale(Interval::new(-0.7, -0.7)) + (three - y)
}

/// What only bodies need, of functions that have no value in part of a box.
fn clipped<T: Scalar>(x: T, y: T) -> [T; 5] {
    let z = (x - y).sqrt() * y;
    let links = TwoLinks { gap: [z, x], first: [y, z - x], second: [x, z] };
    let positive = x - T::constant(Interval::point(1.0));
    let clamped = [z.clamped(), z.clamped_square(), z.clamped_slope() * x];
    [
        clamped[0] * x,
        clamped[1] - clamped[2],
        z.greatest(y.square()),
        positive.choose(y, z),
        T::least_square(&links),
    ]
}

fn over(x: [f64; 2], r: [f64; 2]) -> [Affine<2>; 2] {
    // The lanes are boxes of different sizes.
    let line = |k: usize| move |l: usize| Line::variable(x[k], r[k] / (1u32 << (3 * l)) as f64);
    [Affine::along(0, line(0)), Affine::along(1, line(1))]
}

fn holds(f: &Affine<2>, lane: usize, t: [f64; 2], exact: f64) -> bool {
    let (centre, slope, radius) = f.lane(lane);
    let (linear, range) = (centre + slope[0] * t[0] + slope[1] * t[1], f.range().lane(lane));
    let slack = 1e-14 * (1.0 + exact.abs() + centre.abs());
    // Where nothing is known the radius may be no number.
    let is_far = (linear - exact).abs() > radius + slack;
    !is_far && range.lo - slack <= exact && exact <= range.hi + slack
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn forms_enclose(
        x in prop::array::uniform2(-3.0..3.0f64), r in prop::array::uniform2(0.0..0.8f64),
        t in prop::array::uniform2(-1.0..=1.0f64),
    ) {
        let [a, b] = over(x, r);
        let (smooth, bent) = (formula(a, b), clipped(a, b));
        for lane in 0..LANES {
            let at = |k: usize| x[k] + r[k] / (1u32 << (3 * lane)) as f64 * t[k];
            let (x, y) = (at(0), at(1));
            // Where the root's argument is negative there is nothing to enclose.
            if x * x - y * (x * y).sin() >= 0.0 {
                prop_assert!(holds(&smooth, lane, t, formula(x, y)), "{smooth:?} {lane}");
            }
            if x != 1.0 && x >= y {
                for (k, exact) in clipped(x, y).into_iter().enumerate() {
                    prop_assert!(holds(&bent[k], lane, t, exact), "{k} {bent:?} {lane}");
                }
            }
        }
    }

    /// With errors of all kinds in every operand, by exact arithmetic on dyadic numbers.
    #[test]
    fn products_enclose(
        f in prop::array::uniform4(-64..64i32), g in prop::array::uniform4(-64..64i32),
        t in prop::array::uniform2(-8..=8i32), e in prop::array::uniform2(-8..=8i32),
    ) {
        let form = |f: [i32; 4]| Affine::<2> {
            range: Pack::constant(Interval::ENTIRE),
            centre: Lanes::of(f[0].into()),
            slope: [Lanes::of(f[1].into()), Lanes::of(f[2].into())],
            radius: Lanes::of(f[3].abs().into()),
        };
        let [t, u] = t.map(|t| f64::from(t) / 8.0);
        let value = |f: [i32; 4], e: i32| {
            let [c, a, b, r] = f.map(f64::from);
            c + a * t + b * u + r.abs() * (f64::from(e) / 8.0)
        };
        let (x, y) = (value(f, e[0]), value(g, e[1]));
        let both = [
            (form(f) * form(g), x * y), (form(f) + form(g), x + y), (form(f) - form(g), x - y),
            (form(f).square(), x * x),
        ];
        for (form, exact) in both {
            prop_assert!(holds(&form, 0, [t, u], exact), "{form:?} {exact}");
        }
        if form(g).range().lane(0).sign() != 0 {
            prop_assert!(holds(&(form(f) / form(g)), 0, [t, u], x / y));
        }
    }
}

/// The error falls with the square of the box.
#[test]
fn forms_are_tight_to_second_order() {
    let radius =
        |size: f64| formula(over([1.1, 0.7], [size; 2])[0], over([1.1, 0.7], [size; 2])[1]).lane(0).2;
    let (coarse, fine) = (radius(1e-2), radius(1e-3));
    assert!(fine < 0.011 * coarse && fine > 0.009 * coarse, "{coarse} {fine}");
}

/// Numbers that no function has poison what is made of them.
#[test]
fn what_is_divided_by_zero_is_not_known() {
    let [a, b] = over([0.1, 2.0], [0.5, 0.1]);
    for form in [b / a, (b / a) * Affine::zero(), b - b / a, (b / a).sqrt()] {
        let range = form.range();
        assert!(!range.positive()[0] && !range.negative()[0], "{form:?}");
        assert_eq!((range.lo[0], range.hi[0]), (f64::NEG_INFINITY, f64::INFINITY));
        // The finest box is far from zero.
        assert!(range.lo[7].is_finite() && range.hi[7].is_finite());
    }
}
