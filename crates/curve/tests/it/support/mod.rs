//! Check vectors, computed with forty digits, and curves to test with.

#![allow(dead_code, reason = "every test program uses a part of it")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests")]

use glidepath_curve::{ImplicitCurve, ParametricCurve};
use nalgebra::Vector3;
use serde_json::Value;

const VECTORS: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/data/method/parallel-vectors.json"
));

/// One check vector.
pub(crate) struct Vector {
    pub(crate) id: String,
    pub(crate) input: Value,
    pub(crate) expect: Value,
    pub(crate) tolerance: f64,
}

/// The vectors of a kind, at least one.
pub(crate) fn vectors(kind: &str) -> Vec<Vector> {
    let all: Value = serde_json::from_str(VECTORS).unwrap();
    let found: Vec<Vector> = all["vectors"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|v| v["kind"] == kind)
        .map(|v| Vector {
            id: v["id"].as_str().unwrap().to_owned(),
            input: v["input"].clone(),
            expect: v["expect"].clone(),
            tolerance: v["tol_abs"].as_f64().unwrap(),
        })
        .collect();
    assert!(!found.is_empty(), "no vector of kind {kind}");
    found
}

impl Vector {
    pub(crate) fn number(&self, key: &str) -> f64 {
        self.input[key].as_f64().unwrap()
    }

    pub(crate) fn want(&self, key: &str) -> f64 {
        self.expect[key].as_f64().unwrap()
    }

    pub(crate) fn is(&self, got: f64, key: &str) {
        let want = self.want(key);
        assert!(
            (got - want).abs() <= self.tolerance,
            "{}: {key} = {got}, not {want} within {}",
            self.id,
            self.tolerance
        );
    }

    pub(crate) fn is_at(&self, got: &Vector3<f64>, key: &str) {
        let off = (got - point(&self.expect[key])).amax();
        assert!(off <= self.tolerance, "{}: {key} off by {off}", self.id);
    }

    pub(crate) fn curve(&self) -> ParametricCurve {
        parametric(&self.input["curve"])
    }
}

pub(crate) fn point(value: &Value) -> Vector3<f64> {
    let c: Vec<f64> = value
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v.as_f64().unwrap())
        .collect();
    Vector3::from_column_slice(&c)
}

pub(crate) fn formulas(xyz: [&str; 3]) -> ParametricCurve {
    ParametricCurve::parse(xyz).unwrap_or_else(|(i, e)| panic!("{i}: {e:?}"))
}

pub(crate) fn surfaces(fg: [&str; 2]) -> ImplicitCurve {
    ImplicitCurve::parse(fg).unwrap_or_else(|(i, e)| panic!("{i}: {e:?}"))
}

/// A curve of the vectors, as formulas.
pub(crate) fn parametric(curve: &Value) -> ParametricCurve {
    let at = |key: &str| curve[key].as_f64().unwrap();
    let xyz = match curve["type"].as_str().unwrap() {
        "circle" => [
            format!("{}*cos(t)", at("R")),
            format!("{}*sin(t)", at("R")),
            "0".to_owned(),
        ],
        "ellipse" => [
            format!("{}*cos(t)", at("a")),
            format!("{}*sin(t)", at("b")),
            "0".to_owned(),
        ],
        "helix" => [
            format!("{}*cos(t)", at("R")),
            format!("{}*sin(t)", at("R")),
            format!("{}*t", at("c")),
        ],
        "viviani" => [
            format!("{}*(1+cos(t))", at("a")),
            format!("{}*sin(t)", at("a")),
            format!("2*{}*sin(t/2)", at("a")),
        ],
        "cusp" => ["t^2".to_owned(), "t^3".to_owned(), "0".to_owned()],
        "bezier3" => core::array::from_fn(|i| {
            let p: Vec<f64> = (0..4).map(|k| curve["P"][k][i].as_f64().unwrap()).collect();
            let (a, b, c, d) = (p[0], p[1], p[2], p[3]);
            format!("({a})*(1-t)^3 + 3*({b})*(1-t)^2*t + 3*({c})*(1-t)*t^2 + ({d})*t^3")
        }),
        other => panic!("unknown curve {other}"),
    };
    formulas([&xyz[0], &xyz[1], &xyz[2]])
}
