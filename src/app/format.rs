//! Numbers as people read them: SI prefixes, thin spaces, and as many digits as the value deserves.

use crate::math::rgb::Rgb;
use std::time::Duration;

/// U+2009, between a number and its unit and between groups of three digits.
const THIN_SPACE: char = '\u{2009}';
/// What stands where a number is not known, or not finite.
pub const NO_VALUE: &str = "–";

/// `prefixes()[k]` is the prefix for 10^(3 (k − 4)).
const PREFIXES: [&str; 9] = ["p", "n", "µ", "m", "", "k", "M", "G", "T"];

/// Three significant digits with an SI prefix: `12.4 krays/s`, `340 mW`. Beyond pico and tera it is [`scientific`].
pub fn si(value: f64, unit: &str) -> String {
    if !value.is_finite() {
        return NO_VALUE.to_owned();
    }
    if value == 0.0 {
        return format!("0{THIN_SPACE}{unit}");
    }
    let (mantissa, exponent) = mantissa_and_exponent(value);
    let group = exponent.div_euclid(3);
    let Some(prefix) = usize::try_from(group + 4).ok().and_then(|k| PREFIXES.get(k)) else {
        return format!("{}{THIN_SPACE}{unit}", scientific(value));
    };
    let digits_before_point = exponent.rem_euclid(3);
    let scaled = mantissa * 10_f64.powi(digits_before_point);
    let decimals = (2 - digits_before_point) as usize;
    format!("{}{THIN_SPACE}{prefix}{unit}", minus(&format!("{scaled:.decimals$}")))
}

/// An area: three significant digits, or a power of ten where those would need more than two zeros. Prefixes would have
/// to be squared.
pub fn area(square_metres: f64) -> String {
    let number = match square_metres {
        0.0 => "0".to_owned(),
        value if !(1e-3..1e6).contains(&value) => scientific(value),
        value => digits(value, value),
    };
    format!("{number}{THIN_SPACE}m²")
}

/// Three channels in one unit, with the digits that the largest deserves: `0.725 0.710 0.680`, `12.4 9.1 0.1 W/m²`.
pub fn rgb(value: Rgb, unit: &str) -> String {
    let numbers = match value {
        _ if !value.is_finite() => NO_VALUE.to_owned(),
        Rgb::ZERO => "0".to_owned(),
        _ => channels(value).join(" "),
    };
    if unit.is_empty() { numbers } else { format!("{numbers}{THIN_SPACE}{unit}") }
}

/// Three channels, each by itself, with the digits that the largest deserves.
pub fn channels(value: Rgb) -> [String; 3] {
    let largest = f64::from(value.abs().max_element());
    let number = |channel: f32| match f64::from(channel) {
        channel if !channel.is_finite() => NO_VALUE.to_owned(),
        0.0 => "0".to_owned(),
        channel if (1e-3..1e6).contains(&largest) => digits(channel, largest),
        channel => scientific(channel),
    };
    value.to_array().map(number)
}

/// Three significant digits, or a power of ten where those would need more than two zeros: `0.707`, `12.4`, `3.1e−7`.
pub fn figure(value: f64) -> String {
    match value {
        _ if !value.is_finite() => NO_VALUE.to_owned(),
        0.0 => "0".to_owned(),
        value if !(1e-3..1e6).contains(&value.abs()) => scientific(value),
        value => digits(value, value.abs()),
    }
}

/// A number with as many decimals as give `largest` three significant digits.
fn digits(value: f64, largest: f64) -> String {
    let (_, exponent) = mantissa_and_exponent(largest);
    let decimals = (2 - exponent).max(0) as usize;
    minus(&format!("{value:.decimals$}"))
}

/// An SI prefix and as few digits as it takes, for the axis of a chart: `0`, `200`, `1.5 k`, `20 M`, `400 ms`.
pub fn short(value: f64, unit: &str) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let text = si(value, unit);
    let (number, unit) = text.split_once(THIN_SPACE).unwrap_or((&text, ""));
    let number = if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number };
    if unit.is_empty() { number.to_owned() } else { format!("{number}{THIN_SPACE}{unit}") }
}

/// A whole number in groups of three digits: `20 480`.
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut grouped = String::with_capacity(digits.len() * 2);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            grouped.push(THIN_SPACE);
        }
        grouped.push(digit);
    }
    grouped
}

/// A count with its noun in the right number: `1 shot`, `20 480 shots`, `3 patches`.
pub fn counted(value: u64, noun: &str) -> String {
    let ending = match noun.as_bytes() {
        _ if value == 1 => "",
        [.., b'c' | b's', b'h'] | [.., b's' | b'x'] => "es",
        _ => "s",
    };
    format!("{} {noun}{ending}", count(value))
}

/// A number with a fixed number of decimals and its unit: `−1.5 EV`.
pub fn decimal(value: f64, decimals: usize, unit: &str) -> String {
    format!("{}{THIN_SPACE}{unit}", minus(&format!("{value:.decimals$}")))
}

/// Reads a number as the functions of this module write it, or as people type it: with or without its unit, with an SI
/// prefix before it, with any spaces and either minus sign. `None` if it is no finite number.
pub fn parse(text: &str, unit: &str) -> Option<f64> {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let text = text.replace('\u{2212}', "-");
    let text = text.strip_suffix(unit).unwrap_or(&text);
    let (number, exponent) = match PREFIXES.iter().position(|prefix| !prefix.is_empty() && text.ends_with(prefix)) {
        Some(k) => (text.strip_suffix(PREFIXES[k])?, 3 * (k as i32 - 4)),
        None => (text, 0),
    };
    let value = number.parse::<f64>().ok()? * 10_f64.powi(exponent);
    value.is_finite().then_some(value)
}

/// A share of one as a percentage, with at least two significant digits: `42.0 %`, `0.10 %`, `2.5e−5 %`.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let number = match percent.abs() {
        p if !p.is_finite() => return NO_VALUE.to_owned(),
        0.0 => "0".to_owned(),
        p if p >= 9.995 => format!("{percent:.1}"),
        p if p >= 0.0995 => format!("{percent:.2}"),
        p if p >= 0.000_995 => format!("{percent:.4}"),
        _ => scientific(percent),
    };
    format!("{}{THIN_SPACE}%", minus(&number))
}

/// A share of one as a whole percentage, rounded down, so that it is 100 % only when all is there.
pub fn percent_whole(share: f32) -> String {
    format!("{}{THIN_SPACE}%", (100.0 * share).floor())
}

/// A share of one as a percentage, without zeros at its end: `100 %`, `0.1 %`.
pub fn percent_short(share: f64) -> String {
    // Two significant digits first, so that 0.1 % is not 0.100000000000001 %.
    let percent: f64 = format!("{:.1e}", 100.0 * share).parse().unwrap_or(f64::NAN);
    format!("{}{THIN_SPACE}%", minus(&percent.to_string()))
}

/// Two significant digits and a power of ten: `3.1e−7`; zero is `0`.
pub fn scientific(value: f64) -> String {
    if !value.is_finite() {
        return NO_VALUE.to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    minus(&format!("{value:.1e}"))
}

/// Six significant digits, with a power of ten where the number is very large or small: `0.190136`, `3.16206e−3`, `12`.
pub fn figures(value: f64) -> String {
    let size = value.abs();
    let number = match size {
        _ if !value.is_finite() => return NO_VALUE.to_owned(),
        _ if value.fract() == 0.0 && size < 1e6 => format!("{value}"),
        _ if (1e-2..1e6).contains(&size) => format!("{value:.*}", (5 - size.log10().floor() as i32).max(0) as usize),
        _ => format!("{value:.5e}"),
    };
    minus(&number)
}

/// A span of time in the two largest units that it fills: `840 ms`, `1.24 s`, `3 min 12 s`, `2 h 05 min`.
pub fn duration(span: Duration) -> String {
    let seconds = span.as_secs();
    match seconds {
        0..60 => si(span.as_secs_f64(), "s"),
        60..3600 => format!("{}{THIN_SPACE}min {:02}{THIN_SPACE}s", seconds / 60, seconds % 60),
        _ => format!("{}{THIN_SPACE}h {:02}{THIN_SPACE}min", seconds / 3600, seconds / 60 % 60),
    }
}

/// `value` = mantissa · 10^exponent with 1 ≤ |mantissa| < 10 *after* rounding to three digits, so that 9.996 becomes
/// 1.00 · 10^1 and not a mantissa of 10. `value` is finite and not 0.
fn mantissa_and_exponent(value: f64) -> (f64, i32) {
    let text = format!("{value:.2e}");
    let (mantissa, exponent) = text.split_once('e').expect("Rust's {:e} always writes an exponent");
    (mantissa.parse().expect("written by format!"), exponent.parse().expect("written by format!"))
}

/// The number with a true minus sign in place of the hyphen.
fn minus(number: &str) -> String {
    number.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Thin spaces are hard to see in a test; write them as `_`.
    fn shown(text: String) -> String {
        text.replace(THIN_SPACE, "_")
    }

    #[test]
    fn si_keeps_three_digits_across_prefixes() {
        assert_eq!(shown(si(12_400.0, "rays/s")), "12.4_krays/s");
        assert_eq!(shown(si(0.34, "W")), "340_mW");
        assert_eq!(shown(si(1.0, "W")), "1.00_W");
        assert_eq!(shown(si(999.6, "W")), "1.00_kW");
        assert_eq!(shown(si(-0.05, "m")), "−50.0_mm");
        assert_eq!(shown(si(0.0, "W")), "0_W");
        assert_eq!(shown(si(3.1e-16, "W")), "3.1e−16_W");
        assert_eq!(si(f64::NAN, "W"), NO_VALUE);
    }

    #[test]
    fn short_numbers_have_no_idle_digits() {
        for (value, unit, expected) in
            [(0.0, "s", "0"), (200.0, "", "200"), (1500.0, "", "1.5_k"), (2e7, "", "20_M"), (0.4, "s", "400_ms")]
        {
            assert_eq!(shown(short(value, unit)), expected);
        }
    }

    #[test]
    fn channels_share_their_digits() {
        assert_eq!(shown(rgb(Rgb::new(0.725, 0.71, 0.68), "")), "0.725 0.710 0.680");
        assert_eq!(shown(rgb(Rgb::new(12.36, 9.1, -0.05), "W/m²")), "12.4 9.1 −0.1_W/m²");
        assert_eq!(shown(rgb(Rgb::new(2e-7, 0.0, 1e-7), "W/m²")), "2.0e−7 0 1.0e−7_W/m²");
        assert_eq!(shown(rgb(Rgb::ZERO, "W/m²")), "0_W/m²");
        assert_eq!(rgb(Rgb::NAN, ""), NO_VALUE);
        assert_eq!(shown(area(0.01234)), "0.0123_m²");
        assert_eq!(shown(area(1e-9)), "1.0e−9_m²");
        assert_eq!(shown(area(1234.0)), "1234_m²");
    }

    #[test]
    fn counts_are_grouped_by_three() {
        assert_eq!(shown(count(7)), "7");
        assert_eq!(shown(count(1_000)), "1_000");
        assert_eq!(shown(count(12_345_678)), "12_345_678");
        assert_eq!(counted(1, "shot"), "1 shot");
        assert_eq!(counted(2, "shot"), "2 shots");
    }

    #[test]
    fn plurals() {
        assert_eq!(counted(2, "patch"), "2 patches");
        assert_eq!(counted(0, "ray"), "0 rays");
    }

    #[test]
    fn what_is_written_can_be_read() {
        for value in [0.0156, 3.0, -0.5e-6, 2.5e7] {
            let read = parse(&si(value, "m"), "m");
            assert!(read.is_some_and(|read| (read - value).abs() < 1e-9 * value.abs()), "{value} became {read:?}");
        }
        assert_eq!(parse(&count(12_345), ""), Some(12_345.0));
        assert_eq!(parse("0.1", "%"), Some(0.1));
        assert_eq!(parse("-2 EV", "EV"), Some(-2.0));
        assert_eq!(parse("bright", "EV"), None);
        assert_eq!(parse("inf", "m"), None);
    }

    #[test]
    fn percentages_keep_two_significant_digits() {
        assert_eq!(shown(percent(1.0)), "100.0_%");
        assert_eq!(shown(percent(0.0123)), "1.23_%");
        assert_eq!(shown(percent(0.001)), "0.10_%");
        assert_eq!(shown(percent(0.000_5)), "0.0500_%");
        assert_eq!(shown(percent(2.5e-7)), "2.5e−5_%");
        assert_eq!(shown(percent(0.0)), "0_%");
        assert_eq!(shown(percent_short(10_f64.powi(-3))), "0.1_%");
        assert_eq!(shown(percent_short(1.0)), "100_%");
        assert_eq!(shown(percent_whole(0.439)), "43_%");
        assert_eq!(shown(percent_whole(0.999)), "99_%");
    }

    #[test]
    fn powers_of_ten() {
        assert_eq!(scientific(3.14e-7), "3.1e−7");
        assert_eq!(scientific(-9.96e12), "−1.0e13");
        assert_eq!(scientific(0.0), "0");
    }

    #[test]
    fn figures_have_six_digits() {
        for (value, expected) in [
            (0.190_135_882_384_807, "0.190136"),
            (3183.099, "3183.10"),
            (0.003_162_056_838, "3.16206e−3"),
            (-12.0, "−12"),
            (4e9, "4.00000e9"),
        ] {
            assert_eq!(figures(value), expected);
        }
        assert_eq!(figures(f64::NAN), NO_VALUE);
    }

    #[test]
    fn durations_use_the_units_they_fill() {
        assert_eq!(shown(duration(Duration::from_millis(840))), "840_ms");
        assert_eq!(shown(duration(Duration::from_secs(192))), "3_min 12_s");
        assert_eq!(shown(duration(Duration::from_secs(7_500))), "2_h 05_min");
    }
}
