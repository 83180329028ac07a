//! Error over seconds as a chart in a file, both by their logarithms.

use crate::accuracy::exponent;
use crate::choice::Choice;
use crate::study::{Measured, Study, Way};
use plotters::chart::{ChartBuilder, ChartContext, SeriesLabelPosition};
use plotters::coord::Shift;
use plotters::coord::combinators::{IntoLogRange, LogCoord};
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{Circle, PathElement, Rectangle};
use plotters::prelude::{Cartesian2d, SVGBackend};
use plotters::series::{LineSeries, PointSeries};
use plotters::style::{BLACK, Color, IntoFont, RGBColor, ShapeStyle, WHITE};
use std::error::Error;
use std::ops::Range;

const SIZE: (u32, u32) = (960, 640);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;
type Failed = Box<dyn Error + Send + Sync>;

/// The chart as SVG.
///
/// # Errors
/// If it cannot be drawn.
pub fn svg(scene: &str, study: &Study) -> Result<String, Failed> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw(&area, scene, study).map_err(|error| error.to_string())?;
        area.present().map_err(|error| error.to_string())?;
    }
    Ok(text)
}

fn draw(area: &Area<'_>, scene: &str, study: &Study) -> Result<(), Box<dyn Error>> {
    area.fill(&WHITE)?;
    let (x, y) = ranges(study);
    let mut chart = ChartBuilder::on(area)
        .caption(format!("What accuracy costs in time: {scene}"), ("sans-serif", 22).into_font())
        .margin(16)
        .x_label_area_size(48)
        .y_label_area_size(72)
        .build_cartesian_2d(x.clone().log_scale(), y.clone().log_scale())?;
    chart
        .configure_mesh()
        .x_desc("solver time, s")
        .y_desc("error, % of the mean irradiance")
        .x_labels(12)
        .y_labels(12)
        .x_label_formatter(&|seconds| short(*seconds))
        .y_label_formatter(&|percent| short(*percent))
        .label_style(("sans-serif", 15))
        .light_line_style(RGBColor(236, 236, 236))
        .bold_line_style(RGBColor(208, 208, 208))
        .draw()?;
    floor(&mut chart, study, &x, &y)?;
    for &way in Way::ALL {
        runs(&mut chart, study, way)?;
    }
    front(&mut chart, study)?;
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerLeft)
        .background_style(WHITE.mix(0.9))
        .border_style(RGBColor(160, 160, 160))
        .label_font(("sans-serif", 15))
        .draw()?;
    Ok(())
}

/// Of both axes, with some room on each side.
fn ranges(study: &Study) -> (Range<f64>, Range<f64>) {
    let range = |values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = values
            .filter(|value| *value > 0.0)
            .fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
        if low < high { low / 1.5..high * 1.5 } else { 0.01..100.0 }
    };
    let seconds = range(&mut study.measured.iter().map(|measured| measured.price.seconds));
    let errors = range(&mut study.measured.iter().map(percent));
    (seconds, errors)
}

fn percent(measured: &Measured) -> f64 {
    100.0 * measured.error.rms
}

/// The band in which the reference's own error is, and little can be told.
fn floor(chart: &mut Chart<'_, '_>, study: &Study, x: &Range<f64>, y: &Range<f64>) -> Result<(), Box<dyn Error>> {
    let floor = 100.0 * study.truth.floor;
    if floor <= y.start {
        return Ok(());
    }
    let band = Rectangle::new([(x.start, y.start), (x.end, floor.min(y.end))], RGBColor(225, 225, 232).filled());
    chart
        .draw_series(std::iter::once(band))?
        .label("the reference's own error")
        .legend(|(x, y)| Rectangle::new([(x, y - 5), (x + 20, y + 5)], RGBColor(225, 225, 232).filled()));
    Ok(())
}

/// The runs of a way: each a line from state to state.
fn runs(chart: &mut Chart<'_, '_>, study: &Study, way: Way) -> Result<(), Box<dyn Error>> {
    let colour = colour(way);
    let of_way: Vec<&Measured> = study.measured.iter().filter(|measured| measured.recipe.way == way).collect();
    let Some(most) = of_way.iter().map(|measured| measured.run).max() else { return Ok(()) };
    for run in 0..=most {
        let points: Vec<(f64, f64)> = of_way
            .iter()
            .filter(|measured| measured.run == run && measured.error.rms > 0.0)
            .map(|measured| (measured.price.seconds, percent(measured)))
            .collect();
        chart.draw_series(LineSeries::new(points.iter().copied(), colour.mix(0.6).stroke_width(1)))?;
        chart.draw_series(PointSeries::<_, _, Circle<_, _>, _>::new(points, 2, colour.filled()))?;
    }
    let slope = study.slopes.iter().find(|(other, _)| *other == way);
    let label = match slope {
        Some((_, slope)) => format!("{}, exponent {}", way.label(), exponent(*slope)),
        None => way.label().to_owned(),
    };
    let style = ShapeStyle::from(colour).stroke_width(3);
    let line = LineSeries::new(std::iter::empty(), colour);
    chart.draw_series(line)?.label(label).legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 20, y)], style));
    Ok(())
}

/// The runs that no other beats, joined.
fn front(chart: &mut Chart<'_, '_>, study: &Study) -> Result<(), Box<dyn Error>> {
    let points = study.front.iter().map(|&index| &study.measured[index]);
    let points: Vec<(f64, f64)> =
        points.filter(|on| on.error.rms > 0.0).map(|on| (on.price.seconds, percent(on))).collect();
    let style = BLACK.stroke_width(2);
    chart
        .draw_series(LineSeries::new(points.iter().copied(), style))?
        .label("the front")
        .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 20, y)], style));
    chart.draw_series(PointSeries::<_, _, Circle<_, _>, _>::new(points, 4, BLACK.stroke_width(2)))?;
    Ok(())
}

/// Colours that are told apart also by those who see few (Okabe, Ito 2008).
fn colour(way: Way) -> RGBColor {
    match way {
        Way::Radiosity => RGBColor(0, 114, 178),
        Way::PhotonMap => RGBColor(213, 94, 0),
        Way::RadiosityDirect => RGBColor(86, 180, 233),
        Way::FinalGather => RGBColor(230, 159, 0),
        Way::DiffuseAo => RGBColor(204, 121, 167),
        Way::Reference => RGBColor(0, 158, 115),
    }
}

/// As few digits as say it.
fn short(number: f64) -> String {
    if number >= 1.0 { format!("{number:.0}") } else { format!("{}", (number * 1e4).round() / 1e4) }
}
