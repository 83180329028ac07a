//! All that a study has measured, as a table for other programs.

use crate::accuracy::Error;
use crate::choice::Choice;
use crate::study::Study;

/// One line for each outcome. Errors are shares of the mean irradiance.
pub fn csv(study: &Study) -> String {
    let mut text =
        String::from("run,method,options,finished,seconds,rays,bytes,error,error_uncertainty,noise,bias,on_front\n");
    let optional = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    for (index, measured) in study.measured.iter().enumerate() {
        let Error { rms, uncertainty, noise, .. } = measured.error;
        text += &format!(
            "{},{},{},{},{},{},{},{rms},{uncertainty},{},{},{}\n",
            measured.run,
            measured.recipe.way.name(),
            measured.recipe.options(),
            measured.is_finished,
            measured.price.seconds,
            measured.price.rays,
            measured.price.bytes,
            optional(noise),
            optional(measured.error.bias()),
            study.front.contains(&index),
        );
    }
    text
}
