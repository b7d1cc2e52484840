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
fn a_chart_omits_values_that_its_axes_cannot_show() {
    let picture = chart(&[1.0, f64::NAN, 0.0, -3.0, f64::INFINITY, 1e-9]).draw();
    assert_finite(&picture.inline().into_string());
    assert_finite(&picture.standalone());
    assert_eq!(picture.inner.0.matches("<g class=\"dot").count(), 2);
}

#[test]
fn charts_of_one_point_and_of_no_point_have_axes() {
    for y in [&[1e-3][..], &[]] {
        let picture = chart(y).draw();
        assert_finite(&picture.inner.0);
        assert!(picture.inner.0.contains("class=\"grid\""));
    }
}

#[test]
fn a_region_with_a_hole_is_one_path_and_omits_points_that_are_not_finite() {
    let square = |size: f64| vec![[-size, -size], [size, -size], [size, size], [-size, size]];
    let picture = region("a frame", &[square(2.0), square(1.0), vec![[f64::NAN, 0.0]], vec![]]);
    assert_finite(&picture.standalone());
    assert!(
        picture.inner.0.contains("M4.0,692.0 692.0,692.0") && picture.inner.0.contains("evenodd"),
        "{}",
        picture.inner.0
    );
    assert_finite(&region("nothing", &[]).standalone());
}

#[test]
fn drawings_in_one_frame_have_one_scale_whatever_their_size() {
    let triangle = |size: f64| [[[0.0, 0.0, 0.0], [size, 0.0, 0.0], [0.0, size, 0.0]]];
    let frame = [[0.0; 3], [4.0, 4.0, 0.0]];
    let [small, large] = [1.0, 2.0].map(|size| triangles_in_frame("", &triangle(size), &frame).unwrap());
    assert_eq!(small.size, large.size);
    assert!(small.inner.0.contains("176.0,692.0") && large.inner.0.contains("348.0,692.0"), "{}", large.inner.0);
    let half = small.clone().scaled(348.0);
    assert_eq!(half.size, (348.0, 348.0));
    assert!(half.inner.0.contains("viewBox=\"0 0 696 696\""), "{}", half.inner.0);
}

#[test]
fn titles_are_escaped() {
    assert!(chart(&[1.0]).draw().inner.0.contains("<title>a &lt; b</title>"));
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
fn a_map_shows_its_cells_and_curves() {
    let cell = |column, shade| Cell { column, row: 0, shade, text: String::new(), title: "t".to_owned() };
    let map = HeatMap {
        label: "a map".to_owned(),
        columns: ("dt".to_owned(), vec!["1".to_owned(), "2".to_owned()]),
        rows: ("E".to_owned(), vec!["3".to_owned()]),
        cells: vec![cell(0, Shade::Good), cell(1, Shade::Bad)],
        curves: vec![("limit".to_owned(), vec![(0.0, 0.0), (1.0, f64::NAN), (1.0, 0.0)])],
        cell: (60.0, 30.0),
    };
    let picture = map.draw();
    assert_finite(&picture.standalone());
    assert_eq!(picture.inner.0.matches("class=\"cell").count(), 2);
    assert_eq!(picture.legend.len(), 1);
}

#[test]
fn the_longest_bar_fills_the_width() {
    let bar = |shares: &[f64]| Bar { name: "b".to_owned(), shares: shares.to_vec(), figure: String::new() };
    let picture =
        bars("some bars", &[("x", 0), ("y", 1)], &[bar(&[1.0, 3.0]), bar(&[2.0, f64::NAN])], |part, whole| {
            format!("{part}/{whole}")
        });
    assert_finite(&picture.inner.0);
    assert!(picture.inner.0.contains("width=\"379.2\"") && picture.inner.0.contains("b: y 3/4"), "{}", picture.inner.0);
}

#[test]
fn rows_of_dots_omit_values_that_are_not_positive() {
    let dot = |x: f64| (Dot { x, title: "<t>".to_owned(), ..Dot::default() }, 7);
    let row = |name: &str, xs: &[f64]| DotRow {
        name: name.to_owned(),
        dots: xs.iter().copied().map(dot).collect(),
        figure: String::new(),
    };
    let picture = dot_rows("rows", &Axis::log("error"), &[row("a", &[1e-3, 1.0]), row("b", &[0.0, f64::NAN])]);
    assert_finite(&picture.standalone());
    assert_eq!(picture.inner.0.matches("<g class=\"dot k7\">").count(), 2);
    assert_eq!(picture.inner.0.matches("<title>&lt;t&gt;</title>").count(), 2);
}

#[test]
fn the_last_tenth_of_a_histogram_includes_one() {
    let inner = histogram("shares", &[0.0, 0.95, 1.0, f64::NAN]).inner.0;
    assert!(
        inner.contains("<title>0 to 10 %: 1</title>") && inner.contains("<title>90 to 100 %: 2</title>"),
        "{inner}"
    );
}

#[test]
fn a_distribution_has_a_bar_for_each_bin_with_values_and_names_its_ends() {
    let ends = ["0", "1", "2", ""].map(str::to_owned);
    let picture = distribution("shares", &ends, &[3, 0, 1]);
    assert_eq!(picture.inner.0.matches("<rect").count(), 2);
    assert!(picture.inner.0.contains("0 … 1: 3, 75.00 %"));
    assert_finite(&distribution("no values", &[], &[]).standalone());
}

#[test]
fn a_grid_holds_every_picture_under_its_label() {
    let one = distribution("first", &["0".to_owned(), "1".to_owned()], &[1]);
    let all = grid("both", 1, &[one.clone(), distribution("second", &[], &[])]);
    assert!(all.inner.0.contains(">first<") && all.inner.0.contains(">second<"));
    assert!(all.size.1 > 2.0 * one.size.1 && all.size.0 == one.size.0);
    assert_finite(&grid("no picture", 2, &[]).standalone());
}

#[test]
fn triangles_that_are_hidden_are_left_out() {
    let flat = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]];
    let count =
        |all: &[[[f64; 3]; 3]]| triangles("a body", all).map(|picture| picture.inner.0.matches("<polygon").count());
    let small = flat(-1e-3).map(|[x, y, z]| [0.2 + 0.2 * x, 0.2 + 0.2 * y, z]);
    assert_eq!(count(&[flat(0.0), small]), Some(1), "the front one hides the other");
    assert_eq!(count(&[flat(0.0), flat(5.0)]), Some(2), "seen beside each other");
    assert_eq!(count(&[flat(f64::NAN), flat(0.0)]), Some(1));
    assert_eq!(count(&[]), None);
    assert_finite(&triangles("a point", &[[[1.0; 3]; 3]]).unwrap().standalone());
}

#[test]
fn a_file_of_its_own_has_colours_that_every_viewer_knows() {
    let file = chart(&[1.0, 0.1]).draw().standalone();
    assert!(!file.contains("var(") && !file.contains("--k"), "{file}");
    for rule in ["svg .paper { fill: #ffffff; }", "svg .k1 .curve, svg .curve.k1 { fill: none; stroke: #d1600a;"] {
        assert!(file.contains(rule), "{rule} is not in {file}");
    }
}
