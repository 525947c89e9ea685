// rustc -O verlet.rs
fn main() {
    for line in std::io::stdin().lines().map_while(Result::ok) {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["bye"] => break,
            ["hello", ..] => println!("hello 1 my verlet"),
            ["pendulum", ref numbers @ .., n, k] => {
                let numbers: Vec<f64> = numbers.iter().map(|x| x.parse().unwrap()).collect();
                let [g_over_l, mut theta, mut omega, h] = numbers[..] else { panic!("{line}") };
                let [n, k] = [n, k].map(|x| x.parse::<u64>().unwrap());
                let (mut force, mut evaluations) = (-g_over_l * theta.sin(), 1);
                for step in 1..=n {
                    omega += h / 2.0 * force;
                    theta += h * omega;
                    force = -g_over_l * theta.sin();
                    evaluations += 1;
                    omega += h / 2.0 * force;
                    if step % k == 0 {
                        println!("{theta:?} {omega:?}");
                    }
                }
                println!("done {evaluations}");
            }
            _ => println!("unsupported"),
        }
    }
}
