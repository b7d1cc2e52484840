//! The socket of calls and answers.

use std::io;

/// On Unix one of two connected sockets, which no other process can reach; elsewhere the parent listens on this machine's own
/// address.
#[cfg(unix)]
pub type Socket = std::os::unix::net::UnixStream;
/// On Unix one of two connected sockets, which no other process can reach; elsewhere the parent listens on this machine's own
/// address.
#[cfg(not(unix))]
pub type Socket = std::net::TcpStream;

/// The parent's socket is the standard input.
#[cfg(unix)]
pub(crate) fn parent() -> io::Result<Socket> {
    use std::os::fd::AsFd;
    Ok(io::stdin().as_fd().try_clone_to_owned()?.into())
}

/// The parent's port is the program's first argument.
#[cfg(not(unix))]
pub(crate) fn parent() -> io::Result<Socket> {
    let port: u16 = std::env::args().nth(1).and_then(|port| port.parse().ok()).ok_or(io::ErrorKind::InvalidInput)?;
    let socket = Socket::connect((std::net::Ipv4Addr::LOCALHOST, port))?;
    // Each frame is waited for, so it must be sent at once.
    socket.set_nodelay(true)?;
    Ok(socket)
}
