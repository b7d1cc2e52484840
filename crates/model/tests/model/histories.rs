//! Histories in files.

use fem_model::simulation::History;

#[test]
fn a_history_is_read_as_it_was_written() {
    let mut history = History::default();
    history.put("single", [0.5, -0.0, f64::from(f32::MIN_POSITIVE), f64::from(0.1f32)]);
    history.put("double", [0.1, -1e300, 5e-324]);
    history.put("empty", []);
    let text = serde_json::to_string(&history).unwrap();
    assert!(text.contains("\"single\":\"f32:") && text.contains("\"double\":\"f64:"), "{text}");
    let again: History = serde_json::from_str(&text).unwrap();
    for name in ["single", "double", "empty"] {
        let bits = |history: &History| history.get(name).unwrap().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&again), bits(&history), "{name}");
    }
    assert!(history.get("other").unwrap_err().contains("`other`"));
}

#[test]
fn a_damaged_array_is_refused() {
    for text in ["{\"a\":\"f64:AAAA\"}", "{\"a\":\"f64:?\"}", "{\"a\":\"AAAAAAAAAAA=\"}", "{\"a\":\"f32:AADAfw==\"}"] {
        assert!(serde_json::from_str::<History>(text).is_err(), "{text}");
    }
}
