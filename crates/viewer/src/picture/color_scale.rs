//! The scale between the values of a field and colours.

use fem_output::ElementField;

use super::numbers::round_up;

/// Colours from low to high, sRGB: the map viridis of matplotlib (CC0), at even distances. It is monotonic in lightness, and readers who do
/// not tell red from green can read it.
const VIRIDIS: [[u8; 3]; 11] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x24, 0x75],
    [0x41, 0x44, 0x87],
    [0x35, 0x5f, 0x8d],
    [0x2a, 0x78, 0x8e],
    [0x21, 0x91, 0x8c],
    [0x22, 0xa8, 0x84],
    [0x44, 0xbf, 0x70],
    [0x7a, 0xd1, 0x51],
    [0xbd, 0xdf, 0x26],
    [0xfd, 0xe7, 0x25],
];

/// The upper end is lowered when the largest value falls below this part of it.
const FALLS_BELOW: f64 = 0.3;

/// Ratio of circumradius to edge at the end of the scale; worse elements have the same colour.
const WORST: f64 = 1.5;

/// A colour of the scale, sRGB; `share` lies between 0 and 1.
pub fn color(share: f32) -> [u8; 3] {
    let place = share.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f32;
    let below = (place as usize).min(VIRIDIS.len() - 2);
    let part = place - below as f32;
    std::array::from_fn(|i| {
        let (a, b) = (f32::from(VIRIDIS[below][i]), f32::from(VIRIDIS[below + 1][i]));
        (a + (b - a) * part).round() as u8
    })
}

/// The range of values of a field that the colours span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorScale {
    /// The field.
    pub field: ElementField,
    /// Value of the first colour, in the field's unit.
    pub low: f64,
    /// Value of the last colour.
    pub high: f64,
}

impl ColorScale {
    /// A scale for a field of these values. It ends at a round number and begins at zero, or at minus that number if there are negative values.
    pub fn new(field: ElementField, values: &[f64]) -> Self {
        match field {
            // The best value of a triangle is the smaller one of both kinds of element.
            ElementField::Quality => ColorScale { field, low: 1.0 / 3f64.sqrt(), high: WORST },
            _ => {
                // A small number for a field of zeros.
                let largest = largest(values);
                let high = if largest < 1e-300 { 1e-6 } else { round_up(largest, &[1.0, 2.0, 3.0, 5.0]) };
                let low = if values.iter().any(|&value| value < 0.0) { -high } else { 0.0 };
                ColorScale { field, low, high }
            }
        }
    }

    /// The scale for the next values: the former one, unless they exceed it or fill a small part of it only.
    pub fn next(former: Option<Self>, field: ElementField, values: &[f64]) -> Self {
        let fits = |scale: &Self| {
            let largest = largest(values);
            let has_room = scale.low < 0.0 || values.iter().all(|&value| value >= 0.0 || value.is_nan());
            scale.field == field && has_room && largest <= scale.high && largest >= FALLS_BELOW * scale.high
        };
        former.filter(fits).unwrap_or_else(|| Self::new(field, values))
    }

    /// The place of a value between both ends, from 0 to 1; values beyond an end are at it, and those that are not finite at the last.
    pub fn share(&self, value: f64) -> f32 {
        let share = (value - self.low) / (self.high - self.low);
        if share.is_finite() { share.clamp(0.0, 1.0) as f32 } else { 1.0 }
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).filter(|value| value.is_finite()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_colours_span_the_map_and_get_lighter() {
        assert_eq!((color(0.0), color(1.0)), (VIRIDIS[0], VIRIDIS[10]));
        let lightness = |share: f32| {
            let [r, g, b] = color(share).map(f32::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        assert!((0..50).all(|i| lightness(i as f32 / 50.0) < lightness((i + 1) as f32 / 50.0)));
    }

    #[test]
    fn a_scale_begins_at_zero_and_ends_at_a_round_number() {
        let scale = ColorScale::new(ElementField::Stress, &[0.0, 1234.0, f64::NAN]);
        assert_eq!((scale.low, scale.high), (0.0, 2000.0));
        assert_eq!(
            [scale.share(-1.0), scale.share(500.0), scale.share(1e9), scale.share(f64::NAN)],
            [0.0, 0.25, 1.0, 1.0]
        );
    }

    #[test]
    fn a_scale_with_negative_values_reaches_as_far_below_zero_as_above() {
        let scale = ColorScale::new(ElementField::Pressure, &[100.0, -1234.0]);
        assert_eq!((scale.low, scale.high), (-2000.0, 2000.0));
        let positive = ColorScale::new(ElementField::Pressure, &[1000.0]);
        assert_eq!(ColorScale::next(Some(positive), ElementField::Pressure, &[1000.0, -1.0]).low, -1000.0);
    }

    #[test]
    fn a_body_without_stress_has_the_first_colour() {
        let scale = ColorScale::new(ElementField::Stress, &[0.0; 4]);
        assert_eq!(scale.share(0.0), 0.0);
        assert!(scale.high > 0.0);
    }

    #[test]
    fn a_scale_stays_until_values_leave_it_or_become_small() {
        let first = ColorScale::new(ElementField::Stress, &[900.0]);
        let next = |largest: f64| ColorScale::next(Some(first), ElementField::Stress, &[largest]).high;
        assert_eq!([next(950.0), next(400.0), next(1500.0), next(50.0)], [1000.0, 1000.0, 2000.0, 50.0]);
        assert_eq!(ColorScale::next(Some(first), ElementField::PlasticStrain, &[0.15]).high, 0.2);
    }

    #[test]
    fn the_scale_of_quality_is_the_same_for_all_meshes() {
        assert_eq!(ColorScale::new(ElementField::Quality, &[0.6]), ColorScale::new(ElementField::Quality, &[9.0]));
    }
}
