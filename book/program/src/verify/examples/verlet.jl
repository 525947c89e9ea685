function answer(g_over_l, theta, omega, h, n, k)
    force, evaluations = -g_over_l * sin(theta), 1
    for step in 1:n
        omega += h / 2 * force
        theta += h * omega
        force, evaluations = -g_over_l * sin(theta), evaluations + 1
        omega += h / 2 * force
        step % k == 0 && println(theta, " ", omega)
    end
    println("done ", evaluations)
end

for line in eachline(stdin)
    word, numbers... = split(line)
    if word == "hello"
        println("hello 1 my verlet")
    elseif word == "pendulum"
        answer(parse.(Float64, numbers[1:4])..., parse.(Int, numbers[5:6])...)
    elseif word == "bye"
        break
    else
        println("unsupported")
    end
    flush(stdout)
end
