use serde_json::{Value, from_str};

type Force<'a> = &'a dyn Fn(f64, f64) -> f64;

pub fn step(force: Force, theta: f64, omega: f64, t: f64, h: f64) -> [f64; 2] {
    let half = omega + h / 2.0 * force(theta, t); // yours; here kick, drift, kick
    let theta = theta + h * half;
    [theta, half + h / 2.0 * force(theta, t + h)]
}

// In a test: check(include_str!("known-answers.json"), "stormer-verlet", step)
pub fn check(file: &str, name: &str, step: fn(Force, f64, f64, f64, f64) -> [f64; 2]) {
    let known: Value = from_str(file).unwrap();
    let number = |of: &Value, key: &str| of[key].as_str().unwrap().parse::<f64>().unwrap();
    let method = known["methods"].as_array().unwrap().iter().find(|m| m["name"] == name).unwrap();
    for answer in method["answers"].as_array().unwrap() {
        let s = &known["scenes"][answer["scene"].as_str().unwrap()];
        let [g, a, w] = ["g_over_l", "amplitude", "frequency"].map(|key| number(s, key));
        let [t, h, theta, omega] = ["t", "h", "theta", "omega"].map(|key| number(s, key));
        let force = |theta: f64, t: f64| a * (w * t).cos() - g * theta.sin();
        let next = |[x, v]: [f64; 2], n| step(&force, x, v, t + n as f64 * h, h);
        let end = (0..answer["steps"].as_u64().unwrap()).fold([theta, omega], next);
        let right = ["theta", "omega"].map(|key| number(answer, key));
        let bound = number(answer, "tolerance") * f64::EPSILON * right[0].abs().max(right[1].abs());
        let good = (0..2).all(|i| (end[i] - right[i]).abs() <= bound);
        assert!(good, "{}, {} steps: {end:?}, not {right:?}", answer["scene"], answer["steps"]);
    }
}
