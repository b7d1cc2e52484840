//! Checks for a display server and a graphics adapter before a window is opened.
//!
//! winit ends the program if it finds no display, and allows one attempt per process.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;

use crate::panics::panic_message;

/// Checks whether a window can be opened; the error says in one line why not.
pub fn display_available() -> Result<(), String> {
    server_answers()?;
    adapter_available()
}

/// Checks whether wgpu finds a graphics adapter, hardware or software; the error says why not.
pub fn adapter_available() -> Result<(), String> {
    // OpenGL is tried last, because some drivers print complaints then.
    has_adapter(wgpu::Backends::PRIMARY)
        .or_else(|_| has_adapter(wgpu::Backends::all()))
        .map_err(|why| format!("no graphics adapter: {why}"))
}

fn has_adapter(backends: wgpu::Backends) -> Result<(), String> {
    let descriptor = wgpu::InstanceDescriptor { backends, ..wgpu::InstanceDescriptor::new_without_display_handle() };
    let found = without_panic(|| {
        without_wayland_message(|| {
            let instance = wgpu::Instance::new(descriptor);
            pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).map(drop)
        })
    })?;
    found.map_err(|error| one_line(&error.to_string()))
}

/// Calls `request`, which lists graphics adapters, without libwayland's message that XDG_RUNTIME_DIR is not set.
///
/// Mesa's Vulkan layer connects to Wayland for every list of adapters, also if there is no window. libwayland then prints
/// to stderr, and its handler for messages cannot be replaced from safe code.
pub fn without_wayland_message<R>(request: impl FnOnce() -> R) -> R {
    #[cfg(all(unix, not(target_os = "macos")))]
    let _restored_at_the_end = unix::redirect_stderr();
    request()
}

thread_local! {
    /// Panics of this thread become errors and are not printed.
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// Calls into the graphics libraries, which panic if a driver fails, and returns the panic's message as an error.
pub fn without_panic<R>(call: impl FnOnce() -> R) -> Result<R, String> {
    static INSTALL_HOOK: Once = Once::new();
    INSTALL_HOOK.call_once(|| {
        let print = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            if !QUIET.get() {
                print(panic);
            }
        }));
    });
    QUIET.set(true);
    let result = catch_unwind(AssertUnwindSafe(call));
    QUIET.set(false);
    result.map_err(|panic| one_line(&panic_message(panic.as_ref())))
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(not(all(unix, not(target_os = "macos"))))]
fn server_answers() -> Result<(), String> {
    Ok(())
}

#[cfg(all(unix, not(target_os = "macos")))]
use unix::server_answers;

#[cfg(all(unix, not(target_os = "macos")))]
mod unix {
    use std::env;
    use std::fs::File;
    use std::net::{TcpStream, ToSocketAddrs};
    use std::os::fd::OwnedFd;
    use std::os::unix::net::UnixStream;
    use std::path::PathBuf;
    use std::time::Duration;

    use rustix::stdio::{dup2_stderr, stderr};

    /// The stderr of the process, restored when this is dropped.
    pub struct Stderr(OwnedFd);

    impl Drop for Stderr {
        fn drop(&mut self) {
            let _ = dup2_stderr(&self.0);
        }
    }

    /// Redirects stderr to /dev/null if XDG_RUNTIME_DIR is not set.
    pub fn redirect_stderr() -> Option<Stderr> {
        if env::var_os("XDG_RUNTIME_DIR").is_some() {
            return None;
        }
        let null = File::options().write(true).open("/dev/null").ok()?;
        let former = Stderr(rustix::io::dup(stderr()).ok()?);
        dup2_stderr(null).ok()?;
        Some(former)
    }

    const TIMEOUT: Duration = Duration::from_secs(2);

    /// Checks whether a Wayland compositor or an X server accepts a connection.
    pub fn server_answers() -> Result<(), String> {
        let set = |name: &str| env::var(name).ok().filter(|value| !value.is_empty());
        let wayland = set("WAYLAND_DISPLAY").map(|name| wayland(&name, set("XDG_RUNTIME_DIR")));
        let x = set("DISPLAY").map(|name| x_server(&name));
        match (wayland, x) {
            (Some(Ok(())), _) | (_, Some(Ok(()))) => Ok(()),
            (_, Some(Err(why))) | (Some(Err(why)), None) => Err(why),
            (None, None) => Err("no display: neither DISPLAY nor WAYLAND_DISPLAY is set".into()),
        }
    }

    fn wayland(name: &str, folder: Option<String>) -> Result<(), String> {
        let path = PathBuf::from(folder.unwrap_or_default()).join(name);
        let refuse = |error| format!("no display: no Wayland compositor answers at {} ({error})", path.display());
        UnixStream::connect(&path).map(drop).map_err(refuse)
    }

    fn x_server(name: &str) -> Result<(), String> {
        let refuse = |why: String| format!("no display: no X server answers at DISPLAY={name} ({why})");
        let Some((host, number)) = parse(name) else { return Err(refuse("not of the form host:number".into())) };
        match host {
            "" | "unix" => local(number).map_err(|error| refuse(error.to_string())),
            _ => remote(host, number).map_err(|error| refuse(error.to_string())),
        }
    }

    /// Splits `host:number.screen` into host and number.
    pub fn parse(name: &str) -> Option<(&str, u16)> {
        let (host, rest) = name.rsplit_once(':')?;
        let number = rest.split('.').next()?.parse().ok()?;
        Some((host, number))
    }

    fn local(number: u16) -> std::io::Result<()> {
        let path = format!("/tmp/.X11-unix/X{number}");
        if abstract_socket(&path) { Ok(()) } else { UnixStream::connect(path).map(drop) }
    }

    /// X servers on Linux also listen on an abstract socket, which has no file.
    #[cfg(target_os = "linux")]
    fn abstract_socket(path: &str) -> bool {
        use std::os::linux::net::SocketAddrExt;
        use std::os::unix::net::SocketAddr;
        SocketAddr::from_abstract_name(path).and_then(|address| UnixStream::connect_addr(&address)).is_ok()
    }

    #[cfg(not(target_os = "linux"))]
    fn abstract_socket(_: &str) -> bool {
        false
    }

    fn remote(host: &str, number: u16) -> std::io::Result<()> {
        let address = (host, 6000_u16.saturating_add(number)).to_socket_addrs()?.next();
        let address = address.ok_or(std::io::ErrorKind::AddrNotAvailable)?;
        TcpStream::connect_timeout(&address, TIMEOUT).map(drop)
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn display_names_are_parsed() {
            assert_eq!(parse(":0"), Some(("", 0)));
            assert_eq!(parse(":99.0"), Some(("", 99)));
            assert_eq!(parse("localhost:10.0"), Some(("localhost", 10)));
            assert_eq!(parse("nonsense"), None);
        }

        #[test]
        fn the_error_names_the_display_that_does_not_answer() {
            let why = x_server(":63999").unwrap_err();
            assert!(why.contains("DISPLAY=:63999"), "{why}");
            assert!(x_server("nonsense").is_err());
            assert!(wayland("wayland-none", Some("/nonexistent".into())).is_err());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_in_a_library_becomes_an_error() {
        assert_eq!(without_panic(|| panic!("the driver\n failed")), Err::<(), _>("the driver failed".into()));
        assert_eq!(without_panic(|| 3), Ok(3));
    }
}
