//! What is printed, and what is refused, in which words: command lines, each with what it says.

use crate::{pendula, refused, words};

/// Of the commands that compute: each system, each option that changes what is computed, both
/// formats; at the end runs that fail, with their rows until then.
const ANSWERED: &str = "\
exact --theta0 3 --gravity 3 --length 2
exact --theta0 -1e-3
exact --theta0 0
exact --theta0 3.5
exact --theta0 -10
exact --theta0 0.5 --omega0 -7
exact --theta0 1 --omega0 1
exact --theta0 0 --omega0 4 --gravity 4
exact --theta0 -0.5 --omega0 7 --gravity 3 --length 2 --t -3,0,1e3,0.1
exact --theta0 1 --t 0,-3 --format json
simulate --method stormer-verlet --theta0 1 --dt 0.01 --steps 2 --format json
simulate --method dop853 --theta0 -2.9 --omega0 0.3 --gravity 3 --length 2.5 --mass 5 \
    --tolerance 1e-5 --duration -9 --summary
simulate --method dormand-prince --theta0 -2.9 --omega0 0.3 --gravity 3 --length 2.5 --mass 5 \
    --tolerance 1e-5 --duration 2 --format json
simulate --method taylor-series --theta0 -2.9 --omega0 0.3 --gravity 3 --length 2.5 --mass 5 \
    --tolerance 1e-5 --duration 4
simulate --system damped --damping 0.3 --method rk4 --theta0 1.2 --omega0 -0.3 --gravity 4 \
    --length 2 --mass 3 --dt 0.05 --steps 2 --summary
simulate --system damped --damping 0.3 --method stormer-verlet --theta0 1.2 --dt 0.05 --steps 2 \
    --format json
simulate --system driven --damping 0.3 --drive-strength 1.1 --drive-frequency 2.5 --method \
    gauss-6 --theta0 1.2 --dt 0.05 --steps 2 --summary
simulate --system driven --drive-strength 1.1 --drive-frequency 2.5 --method rk4 --theta0 1.2 \
    --dt 0.05 --steps 2
simulate --system shaken --pivot-amplitude 0.4 --pivot-frequency 9 --method stormer-verlet \
    --theta0 1.2 --dt 0.05 --steps 2 --summary
simulate --system double-pendulum --theta1 2 --theta2 -0.5 --omega2 1.5 --dt 0.01 --steps 2 \
    --gravity 3 --length1 1.3 --length2 0.6 --mass1 0.7 --mass2 1.9 --summary
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --steps 1 --method gauss-6 \
    --format json
simulate --system double-pendulum --theta1 2 --theta2 -0.5 --tolerance 1e-6 --duration 0.5 \
    --gravity 3 --mass2 1.9 --summary
simulate --system damped --damping 0.3 --method dormand-prince --theta0 1.2 --tolerance 1e-4 \
    --duration -1 --summary
simulate --system driven --drive-strength 1.1 --drive-frequency 2.5 --method dop853 --theta0 1.2 \
    --tolerance 1e-6 --duration 1 --format json
simulate --system shaken --pivot-amplitude 0.4 --pivot-frequency 9 --method dop853 --theta0 1.2 \
    --tolerance 1e-6 --duration 0.5
sweep --method rk4 --theta0 0:1:3 --dt 0.1 --duration 1 --format json
sweep --method rk4 --theta0 1 --dt 0.1:0.001:5 --duration 10
sweep --method rk4 --theta0 1 --dt 0.1:0.4:3 --duration 1
sweep --method rk4 --theta0 1 --dt 0.3:0.1:9 --duration 0.3
simulate --method rk4 --theta0 0 --dt 0.1 --steps 1 --summary
simulate --method forward-euler --theta0 1 --dt 1e200 --steps 9
simulate --method gauss-4 --theta0 1 --dt 5 --steps 9 --format json
simulate --system double-pendulum --theta1 20 --theta2 12 --mass2 1e6 --gravity 3.08 --dt 0.01 \
    --duration 9.76 --every 300 --format json
simulate --method dop853 --theta0 3 --duration 100 --tolerance 1e-10 --max-steps 5 --format json
sweep --method forward-euler --theta0 0:1:5 --dt 1e200 --duration 1e201 --format json
sweep --method gauss-16 --theta0 1:2:3 --dt 5 --duration 20 --format json
paper claims P6.3.norm T6.se.0.1
paper tables --table 7";

/// Catches: a format that a command does not pass on, rows under other names, in another order or
/// with other digits; a parameter of a system ignored, or taken for another; upper and lower rod
/// exchanged, momenta printed for velocities; another system, method, tolerance or direction of
/// time than was asked for; an end of the rows left out; a motion with another name, turns counted
/// in the wrong direction, a period where nothing repeats, the parameter k² for the modulus; a
/// summary of another run; rows before a failure that are lost, an array that it leaves open, a
/// step too long for an iteration reported as an overflow; a claim said to be reproduced with a
/// definition, without the definition.
#[test]
fn answers_are_as_they_were() {
    let of = |line| {
        let output = pendula(words(line));
        let printed = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        let is_time = |line: &&str| line.starts_with("wall time") || line.starts_with("steps per");
        let lines: Vec<&str> = printed.lines().filter(|line| !is_time(line)).collect();
        let (said, status) = (lines.join("\n"), output.status.code());
        format!("$ pendula {line}\n{said}\nstatus {}\n", status.unwrap())
    };
    insta::assert_snapshot!(ANSWERED.lines().map(of).collect::<String>());
}

/// Of the command line itself, then command by command.
const REFUSED: &str = "\
bock
book --opne
preprocess supports
paper
sweep
verify
verify --
verify python3
serve
simulate --method rk4 --theta0 --dt 1
simulate --method Euler --theta0 1 --dt 1 --steps 1
simulate --method rk4 --theta0 1 --dt 1
simulate --method rk4 --theta0 1 --duration 1
simulate --theta0 1 --dt 1 --steps 1
simulate --method rk4 --dt 1 --steps 1
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --duration 1
simulate --method rk4 --theta0 1 --dt 0.01 --steps -1
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --every 0
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --length 1m
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --mass nan
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --gravity -9.81
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --omega0 inf
simulate --method rk4 --theta0 1 --dt 0.01 --duration 0.015
simulate --method rk4 --theta0 1 --dt 0.01 --steps 9007199254740993
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --max-steps 2
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --plot /no/such/folder/x.svg
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --output /no/such/folder/x.csv
simulate --method dop853 --theta0 1 --duration 10 --tolerance 0
simulate --method dop853 --theta0 1 --duration 10 --tolerance 1e-16
simulate --method dop853 --theta0 1 --duration inf --tolerance 1e-6
simulate --method dop853 --theta0 nan --duration 10 --tolerance 1e-6
simulate --method dop853 --theta0 1 --duration 10 --tolerance 1e-6 --every 2
simulate --method rk4 --theta0 1 --duration 1 --tolerance 1e-6
simulate --method rk4 --theta0 1 --duration 1 --tolerance 1e-6 --dt 1
simulate --system double-pendulum --method taylor-series --theta1 1 --theta2 1 --duration 1 \
    --tolerance 1e-6
simulate --system double-pendulum --method rk4 --theta1 1 --theta2 1 --duration 1 --tolerance 1e-6
sweep --method rk4 --theta0 0:1:9007199254740993 --dt 0.01 --duration 1
simulate --method taylor-series --theta0 1 --dt 1 --steps 1
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --damping 1
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --theta1 1
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --system dampened
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --system damped
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --system damped --damping -1
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --system driven --drive-frequency 1
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --system shaken --pivot-amplitude 1 --damping 1
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --duration 0.015
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --steps 1 --mass2 0
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --steps 1 --omega1 nan
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --steps 1 --mass 1
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --steps 1 --method deuflhard
simulate --method taylor-24 --theta0 1 --dt 0.05 --steps 4 --system damped --damping 1
sweep --method rk4 --theta0 1 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1:5 --dt 0.1:0.01:5 --duration 10
sweep --method rk4 --theta0 0:1:1 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1:-3 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1:2.5 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1:5:5 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:nan:5 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1e16:5 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1:5 --dt 0.015 --duration 0.1
sweep --method rk4 --theta0 1 --dt inf --duration 10
sweep --method rk4 --theta0 1 --dt -0.1:0.1:5 --duration 10
sweep --method rk4 --theta0 1 --dt 0.1:20:5 --duration 10
sweep --method rk4 --theta0 1 --dt 0.1:1e-300:5 --duration 10
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 3
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 4/3
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 0/3
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 1/0
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part -1/3
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 1/3/3
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 1/18446744073709551616
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part --summary
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 2/3 --format json
sweep --method rk4 --theta0 1 --dt 0.1:1:3 --duration 1 --device p
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --device=
exact --theta0 nan
exact --theta0 2/3pi
exact --theta0 1 --format json
exact --theta0 1 --t 1,two
exact --theta0 3 --t 1e300
exact --theta0 3 --t -inf
exact --theta0 3 --t nan
paper tables --table 3
paper tables --format xml
paper claims --verdict right
bench --seconds -1
verify --claims order=two -- true
verify --claims sympletic -- true
verify --patience 0 -- true
verify --patience -1 -- true
verify --patience nan -- true
verify --format xml -- true
verify --report /no/such/folder/x.html -- true
verify --example perl
verify --example c -- true
completions csh";

/// Where the program to be judged is named, it is not started: `true` would be at fault.
///
/// Catches: bad input that is accepted; a panic, a message of several lines, another exit status; a
/// message that does not say what is allowed, or whose option it is.
#[test]
fn bad_input_is_refused_in_one_line() {
    let of = |line| format!("$ pendula {line}\n{}", refused(&pendula(words(line))));
    let told: Vec<String> = REFUSED.lines().map(of).collect();
    insta::assert_snapshot!(told.concat());
}
