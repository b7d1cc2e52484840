//! Every format follows the published specification of its readers.

use super::*;

/// No key but the documented ones, which stand with spaces between.
fn assert_keys(object: &Value, documented: &str) {
    for key in object.as_object().unwrap().keys() {
        assert!(documented.split_whitespace().any(|found| found == key), "{key} is not documented");
    }
}

#[test]
fn grade_json_has_the_keys_of_the_contract() {
    let grade: Value = serde_json::from_str(&json::render(&sample::grade(0)).unwrap()).unwrap();
    for key in ["format_version", "score", "max_score", "seed", "toolchain", "sandbox", "functions"] {
        assert!(!grade[key].is_null(), "{key}");
    }
    let function = grade["functions"][0].as_object().unwrap();
    for key in ["name", "score", "max_score", "status", "diagnosis", "error", "seconds", "reference_seconds", "checks"]
    {
        assert!(function.contains_key(key), "{key}");
    }
    assert_eq!(grade["seed"].as_u64(), Some(u64::MAX));
}

/// Keys: <https://gradescope-autograders.readthedocs.io/en/latest/specs/>.
#[test]
fn gradescope_gets_documented_keys_and_allowed_values_alone() {
    for grade in [sample::grade(2), sample::hostile()] {
        let results: Value = serde_json::from_str(&gradescope::render(&grade, true).unwrap()).unwrap();
        assert_keys(
            &results,
            "score execution_time output output_format test_output_format test_name_format visibility stdout_visibility \
             extra_data tests leaderboard",
        );
        let score = results["score"].as_f64().unwrap();
        assert!((0.0..=grade.max_score).contains(&score));
        assert_eq!(results["stdout_visibility"], "hidden");
        assert_eq!(results["visibility"], "visible");
        assert!(results["execution_time"].is_number());
        let tests = results["tests"].as_array().unwrap();
        assert_eq!(tests.len(), 23);
        for test in tests {
            assert_keys(
                test,
                "score max_score status name name_format number output output_format tags visibility extra_data",
            );
            assert!(test["score"].as_f64().unwrap() <= test["max_score"].as_f64().unwrap());
            assert!(["passed", "failed"].contains(&test["status"].as_str().unwrap()));
            assert_eq!(test["output_format"], "text");
        }
        for entry in results["leaderboard"].as_array().unwrap() {
            assert_keys(entry, "name value order");
            assert!(entry["value"].is_number() && ["asc", "desc"].contains(&entry["order"].as_str().unwrap()));
        }
    }
}

/// Keys: `schemas/result-v1.schema.json` of foundation50/classroom50.
#[test]
fn classroom50_gets_whole_numbers_and_the_origin() {
    let text = classroom50::render(&sample::grade(2), &options().origin.unwrap(), true).unwrap();
    let result: Value = serde_json::from_str(&text).unwrap();
    let keys = "schema classroom assignment assignment_type owner submission commit release review datetime score max-score tests";
    assert_keys(&result, keys);
    assert!(keys.split(' ').all(|key| !result[key].is_null() && result[key] != ""));
    assert_eq!(result["schema"], "classroom50/result/v1");
    assert!(result["submission"].as_str().unwrap().starts_with("submit/"));
    assert!(result["score"].as_u64().unwrap() <= result["max-score"].as_u64().unwrap());
    assert_eq!(result["max-score"], 10_000);
    for test in result["tests"].as_array().unwrap() {
        assert!(!test["test-name"].as_str().unwrap().is_empty() && test["passed"].is_boolean());
        assert!(test["score"].as_u64().unwrap() <= test["max-score"].as_u64().unwrap());
    }
    assert!(classroom50::Origin::from_variables(|_| None).is_none());
}

#[test]
fn junit_has_a_case_for_every_check_and_for_every_function_without() {
    let grade = sample::grade(2);
    let report = quick_junit::Report::deserialize_from_str(&junit::render(&grade, true).unwrap()).unwrap();
    assert_eq!(report.test_suites.len(), 23);
    for (suite, part) in report.test_suites.iter().zip(view::parts(&grade)) {
        assert_eq!(suite.test_cases.len(), part.checks.len().max(1), "{}", part.name);
        assert_eq!(suite.failures + suite.errors > 0, part.status != grader::status::Status::Passed, "{}", part.name);
    }
    let hostile = junit::render(&sample::hostile(), true).unwrap();
    assert!(!hostile.contains(|c: char| c.is_control() && c != '\n' || c == '\u{ffff}'));
    quick_junit::Report::deserialize_from_str(&hostile).unwrap();
}

/// Elements and attributes of `junit-10.xsd`, which the xUnit plugin of Jenkins holds reports to, as far as we need them.
const JUNIT: [(&str, &str); 9] = [
    ("testsuites", "name time tests failures errors"),
    ("testsuite", "name tests failures errors time skipped timestamp hostname id package"),
    ("properties", ""),
    ("property", "name value"),
    ("testcase", "name time classname"),
    ("failure", "type message"),
    ("error", "type message"),
    ("system-out", ""),
    ("system-err", ""),
];

/// Name and attributes of every tag that opens. Neither `<` nor `"` stands for itself in a text or a value.
fn tags(xml: &str) -> Vec<(&str, Vec<&str>)> {
    let opening = xml.split('<').filter(|tag| !tag.trim().is_empty() && !tag.starts_with(['/', '?']));
    let parts = opening.map(|tag| {
        let inside = &tag[..tag.rfind('>').unwrap()];
        let name = inside.split([' ', '/', '>']).next().unwrap();
        // Every value follows its name.
        let outside = inside[name.len()..].split('"').step_by(2).filter_map(|text| text.trim().strip_suffix('='));
        (name, outside.collect())
    });
    parts.collect()
}

#[test]
fn junit_keeps_to_the_schema_of_jenkins() {
    for grade in [sample::grade(2), sample::hostile()] {
        let text = junit::render(&grade, true).unwrap();
        let tags = tags(&text);
        assert!(tags.len() > 23);
        for (name, attributes) in tags {
            let (_, allowed) = JUNIT.iter().find(|(known, _)| *known == name).expect(name);
            for attribute in attributes {
                assert!(allowed.split(' ').any(|known| known == attribute), "{attribute} of {name}");
            }
        }
    }
}
