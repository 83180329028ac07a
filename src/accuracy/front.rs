//! What error is to be had for what price: the runs that no other beats, and how fast errors fall.

/// A price in seconds and the error that it buys, as a share of the mean irradiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offer {
    pub seconds: f64,
    pub error: f64,
}

/// Which offers no other beats, by their indices, from the cheapest to the dearest: each has a smaller error than all that
/// cost no more.
pub fn front(offers: &[Offer]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..offers.len()).collect();
    order.sort_by(|&a, &b| {
        let (a, b) = (&offers[a], &offers[b]);
        a.seconds.total_cmp(&b.seconds).then(a.error.total_cmp(&b.error))
    });
    let mut least = f64::INFINITY;
    order.retain(|&index| {
        let is_better = offers[index].error < least;
        least = least.min(offers[index].error);
        is_better
    });
    order
}

/// The exponent p of error = c · secondsᵖ, fitted by least squares to the logarithms; `None` for fewer than three offers, or
/// where they cost all the same. Noise of independent samples falls with −1/2.
pub fn slope(offers: &[Offer]) -> Option<f64> {
    let points = || offers.iter().filter(|offer| offer.seconds > 0.0 && offer.error > 0.0);
    let count = points().count();
    if count < 3 {
        return None;
    }
    let (x, y) = (|offer: &Offer| offer.seconds.ln(), |offer: &Offer| offer.error.ln());
    let mean = |value: &dyn Fn(&Offer) -> f64| points().map(value).sum::<f64>() / count as f64;
    let (mean_x, mean_y) = (mean(&x), mean(&y));
    let over = points().map(|offer| (x(offer) - mean_x).powi(2)).sum::<f64>();
    let both = points().map(|offer| (x(offer) - mean_x) * (y(offer) - mean_y)).sum::<f64>();
    (over > 0.0).then(|| both / over)
}

/// The exponent over the last tenfold of time: what it costs to begin, and the first points of a sequence, which are spread
/// better than later ones can be, say nothing of where a run leads. Offers are in the order of time.
pub fn slope_at_end(offers: &[Offer]) -> Option<f64> {
    let from = offers.last()?.seconds / 10.0;
    slope(&offers.iter().copied().filter(|offer| offer.seconds >= from).collect::<Vec<_>>())
}

/// An exponent as it is written.
pub fn exponent(slope: f64) -> String {
    // Of what is nearly 0 no sign.
    let rounded = (100.0 * slope).round() / 100.0 + 0.0;
    format!("{rounded:.2}").replace('-', "−")
}

/// From which offer on errors fall no more, however long one goes on: what is left is bias. `None` unless that was watched for
/// long enough to tell it from noise that falls, which would have lost a sixth meanwhile. Offers are in the order of time.
pub fn level_from(offers: &[Offer]) -> Option<usize> {
    const AS_GOOD: f64 = 1.05;
    const WATCHED: f64 = 1.5;
    let last = offers.last()?;
    let since = offers.iter().rposition(|offer| offer.error > AS_GOOD * last.error).map_or(0, |worse| worse + 1);
    (last.seconds >= WATCHED * offers[since].seconds).then_some(since)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn offer(seconds: f64, error: f64) -> Offer {
        Offer { seconds, error }
    }

    #[test]
    fn a_law_of_powers_has_its_exponent() {
        let offers: Vec<_> = (1..9).map(|i| offer(f64::from(i), 3.0 * f64::from(i).powf(-0.5))).collect();
        assert!((slope(&offers).expect("a slope") + 0.5).abs() < 1e-12);
        let begins_late: Vec<_> = [offer(0.01, 7.0)].into_iter().chain(offers.iter().copied()).collect();
        assert!((slope_at_end(&begins_late).expect("a slope") + 0.5).abs() < 1e-12);
        assert_eq!(slope(&offers[..2]), None);
        assert_eq!(slope(&[offer(1.0, 1.0); 3]), None);
    }

    #[test]
    fn exponents_are_written_with_a_sign_where_they_have_one() {
        assert_eq!([-0.504, -0.001, 0.0, 0.25].map(exponent), ["−0.50", "0.00", "0.00", "0.25"]);
    }

    #[test]
    fn what_falls_like_noise_never_levels_off_and_what_tends_to_a_bias_does() {
        let seconds = || (0..12).map(|i| 0.1 * 1.4_f64.powi(i));
        let noise: Vec<_> = seconds().map(|seconds| offer(seconds, 0.1 * seconds.powf(-0.5))).collect();
        assert_eq!(level_from(&noise), None);
        // The part that falls is a twentieth of the bias from here on.
        let biased: Vec<_> = seconds().map(|seconds| offer(seconds, 0.1 + (-8.0 * seconds).exp())).collect();
        let since = level_from(&biased).expect("a level");
        assert!((-8.0 * biased[since].seconds).exp() <= 0.005 && (-8.0 * biased[since - 1].seconds).exp() > 0.005);
        assert_eq!(level_from(&biased[..since + 2]), None);
        assert_eq!(level_from(&[]), None);
        assert_eq!(level_from(&[offer(1.0, 0.1)]), None);
    }

    proptest! {
        #[test]
        fn a_front_is_monotonic_and_beats_all_others(
            pairs in proptest::collection::vec((0.01..10.0_f64, 0.001..1.0_f64), 0..40)
        ) {
            let offers: Vec<_> = pairs.into_iter().map(|(seconds, error)| offer(seconds, error)).collect();
            let front: Vec<_> = front(&offers).into_iter().map(|index| offers[index]).collect();
            for pair in front.windows(2) {
                prop_assert!(pair[0].seconds < pair[1].seconds && pair[0].error > pair[1].error);
            }
            for other in &offers {
                prop_assert!(front.iter().any(|on| on.seconds <= other.seconds && on.error <= other.error));
            }
        }
    }
}
