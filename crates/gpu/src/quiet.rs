//! Lists of adapters without libwayland's message.

/// Calls `list`, which lists adapters, without libwayland's message that XDG_RUNTIME_DIR is not set: Mesa's Vulkan layer connects to Wayland
/// for every list, also if there is no window, and the handler for messages cannot be replaced from safe code.
pub(crate) fn without_wayland_message<R>(list: impl FnOnce() -> R) -> R {
    #[cfg(all(unix, not(target_os = "macos")))]
    let _restored_at_the_end = unix::silence_stderr();
    list()
}

#[cfg(all(unix, not(target_os = "macos")))]
mod unix {
    use std::fs::File;
    use std::os::fd::OwnedFd;

    use rustix::stdio::{dup2_stderr, stderr};

    /// The stderr of the process, restored when this is dropped.
    pub struct Stderr(OwnedFd);

    impl Drop for Stderr {
        fn drop(&mut self) {
            let _ = dup2_stderr(&self.0);
        }
    }

    /// Leads stderr to /dev/null if XDG_RUNTIME_DIR is not set.
    pub fn silence_stderr() -> Option<Stderr> {
        if std::env::var_os("XDG_RUNTIME_DIR").is_some() {
            return None;
        }
        let null = File::options().write(true).open("/dev/null").ok()?;
        let former = Stderr(rustix::io::dup(stderr()).ok()?);
        dup2_stderr(null).ok()?;
        Some(former)
    }
}
