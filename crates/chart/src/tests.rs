use super::*;

fn chart(y: &[f64]) -> Chart {
    let dot = |(i, &y): (usize, &f64)| Dot { x: 10f64.powi(i as i32), y, title: "a < b".to_owned(), ..Dot::default() };
    let dots = y.iter().enumerate().map(dot).collect();
    let series = Series { name: "some".to_owned(), is_joined: true, has_dots: true, dots, ..Series::default() };
    let mut chart = Chart::new("a chart", Axis::log("time (s)"), Axis::log("error"));
    chart.series.push(series);
    chart.guides = vec![
        Guide::Vertical(f64::NAN, "none".to_owned()),
        Guide::Horizontal(-1.0, "none".to_owned()),
        Guide::Slope { through: (1.0, 1.0), slope: -2.0, name: "2".to_owned() },
    ];
    chart
}

fn assert_finite(text: &str) {
    for word in ["NaN", "inf"] {
        assert!(!text.contains(word), "{text}");
    }
}

#[test]
fn a_chart_leaves_out_what_has_no_place_on_its_axes() {
    let picture = chart(&[1.0, f64::NAN, 0.0, -3.0, f64::INFINITY, 1e-9]).draw();
    assert_finite(&picture.inline());
    assert_finite(&picture.standalone());
    assert_eq!(picture.inner.matches("<g class=\"dot").count(), 2);
}

#[test]
fn a_chart_of_one_point_and_one_of_none_have_axes_too() {
    for y in [&[1e-3][..], &[]] {
        let picture = chart(y).draw();
        assert_finite(&picture.inner);
        assert!(picture.inner.contains("class=\"grid\""));
    }
}

#[test]
fn marks_of_markup_are_spelt_out() {
    assert!(chart(&[1.0]).draw().inner.contains("<title>a &lt; b</title>"));
    assert_eq!(escape("\"&<>"), "&quot;&amp;&lt;&gt;");
}

#[test]
fn ticks_are_powers_of_ten_or_round_numbers() {
    let log = Axis { range: Some((1e-6, 1.0)), ..Axis::log("") }.between(0.0, 1.0, std::iter::empty());
    let names: Vec<String> = log.ticks().into_iter().map(|(_, name)| name).collect();
    assert_eq!(names, ["10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "0.01", "0.1", "1"]);
    let linear = Axis { range: Some((-0.5, 0.5)), ..Axis::linear("") }.between(0.0, 1.0, std::iter::empty());
    let names: Vec<String> = linear.ticks().into_iter().map(|(_, name)| name).collect();
    assert_eq!(names, ["−0.4", "−0.2", "0.0", "0.2", "0.4"]);
}

#[test]
fn a_map_has_its_cells_and_its_curves() {
    let cell = |column, shade| Cell { column, row: 0, shade, text: String::new(), title: "t".to_owned() };
    let map = HeatMap {
        label: "a map".to_owned(),
        columns: ("dt".to_owned(), vec!["1".to_owned(), "2".to_owned()]),
        rows: ("E".to_owned(), vec!["3".to_owned()]),
        cells: vec![cell(0, Shade::Good), cell(1, Shade::Strength(f64::NAN))],
        curves: vec![("limit".to_owned(), vec![(0.0, 0.0), (1.0, f64::NAN), (1.0, 0.0)])],
        cell: (60.0, 30.0),
    };
    let picture = map.draw();
    assert_finite(&picture.standalone());
    assert_eq!(picture.inner.matches("class=\"cell").count(), 2);
    assert_eq!(picture.legend.len(), 1);
}

#[test]
fn the_longest_bar_fills_the_width() {
    let bar = |shares: &[f64]| Bar { name: "b".to_owned(), shares: shares.to_vec(), figure: String::new() };
    let picture = bars("some bars", &["x", "y"], &[bar(&[1.0, 3.0]), bar(&[2.0, f64::NAN])]);
    assert_finite(&picture.inner);
    assert!(picture.inner.contains("width=\"202.5\""), "{}", picture.inner);
}
