//! Seccomp: the system calls that neither a compiler nor a submission needs.

use std::collections::BTreeMap;
use std::env::consts::ARCH;
use std::process;

use nix::libc;
use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter, SeccompRule,
    TargetArch, apply_filter,
};

use super::Profile;

/// System calls that are refused to every program in the sandbox: other processes, mounts, namespaces, users, the machine, new ways into the kernel.
const NEVER: &[i64] = &[
    libc::SYS_socket,
    libc::SYS_ptrace,
    libc::SYS_process_vm_readv,
    libc::SYS_process_vm_writev,
    libc::SYS_process_madvise,
    libc::SYS_pidfd_getfd,
    libc::SYS_kcmp,
    libc::SYS_mount,
    libc::SYS_umount2,
    libc::SYS_move_mount,
    libc::SYS_open_tree,
    libc::SYS_fsopen,
    libc::SYS_fsconfig,
    libc::SYS_fsmount,
    libc::SYS_fspick,
    libc::SYS_mount_setattr,
    libc::SYS_pivot_root,
    libc::SYS_chroot,
    libc::SYS_unshare,
    libc::SYS_setns,
    libc::SYS_name_to_handle_at,
    libc::SYS_open_by_handle_at,
    libc::SYS_bpf,
    libc::SYS_perf_event_open,
    libc::SYS_userfaultfd,
    libc::SYS_io_uring_setup,
    libc::SYS_io_uring_enter,
    libc::SYS_io_uring_register,
    libc::SYS_fanotify_init,
    libc::SYS_add_key,
    libc::SYS_request_key,
    libc::SYS_keyctl,
    libc::SYS_kexec_load,
    libc::SYS_kexec_file_load,
    libc::SYS_init_module,
    libc::SYS_finit_module,
    libc::SYS_delete_module,
    libc::SYS_setuid,
    libc::SYS_setgid,
    libc::SYS_setreuid,
    libc::SYS_setregid,
    libc::SYS_setresuid,
    libc::SYS_setresgid,
    libc::SYS_setfsuid,
    libc::SYS_setfsgid,
    libc::SYS_setgroups,
    libc::SYS_capset,
    libc::SYS_personality,
    libc::SYS_quotactl,
    libc::SYS_acct,
    libc::SYS_swapon,
    libc::SYS_swapoff,
    libc::SYS_reboot,
    libc::SYS_syslog,
    libc::SYS_vhangup,
    libc::SYS_sethostname,
    libc::SYS_setdomainname,
    libc::SYS_settimeofday,
    libc::SYS_clock_settime,
    libc::SYS_adjtimex,
    libc::SYS_clock_adjtime,
    #[cfg(target_arch = "x86_64")]
    libc::SYS_iopl,
    #[cfg(target_arch = "x86_64")]
    libc::SYS_ioperm,
    #[cfg(target_arch = "x86_64")]
    libc::SYS_modify_ldt,
];

/// System calls that are refused to a submission as well: other processes, and shared memory that outlives a process.
const NOT_FOR_SUBMISSIONS: &[i64] = &[
    #[cfg(target_arch = "x86_64")]
    libc::SYS_fork,
    #[cfg(target_arch = "x86_64")]
    libc::SYS_vfork,
    libc::SYS_socketpair,
    libc::SYS_setsid,
    libc::SYS_setpgid,
    libc::SYS_pidfd_open,
    libc::SYS_pidfd_send_signal,
    libc::SYS_memfd_create,
    libc::SYS_shmget,
    libc::SYS_shmat,
    libc::SYS_semget,
    libc::SYS_msgget,
    libc::SYS_mq_open,
];

/// Calls that send a signal to the process that is their first argument.
const SIGNALS: &[i64] =
    &[libc::SYS_kill, libc::SYS_tkill, libc::SYS_tgkill, libc::SYS_rt_sigqueueinfo, libc::SYS_rt_tgsigqueueinfo];

type Rules = BTreeMap<i64, Vec<SeccompRule>>;

/// Restricts this process, for good.
pub fn restrict(profile: Profile) -> Result<(), String> {
    let mut rules: Rules = NEVER.iter().map(|call| (*call, Vec::new())).collect();
    let forbidden = u64::from(libc::EPERM.cast_unsigned());
    match profile {
        Profile::Compiler => {
            rules.insert(libc::SYS_clone, any_of(&NAMESPACES)?);
        }
        Profile::Submission => {
            rules.extend(NOT_FOR_SUBMISSIONS.iter().map(|call| (*call, Vec::new())));
            // Threads only.
            let thread = u64::from(libc::CLONE_THREAD.cast_unsigned());
            rules.insert(libc::SYS_clone, vec![when(0, SeccompCmpOp::MaskedEq(thread), 0)?]);
            // Its own number stays when this process becomes the program.
            let own = u64::from(process::id());
            for call in SIGNALS {
                rules.insert(*call, vec![when(0, SeccompCmpOp::Ne, own)?]);
            }
            rules.insert(libc::SYS_prlimit64, vec![not_itself(own)?]);
        }
    }
    apply(rules, forbidden)?;
    // Its flags are in memory, which filters cannot read. Libraries use `clone` if this call fails.
    apply(Rules::from([(libc::SYS_clone3, Vec::new())]), u64::from(libc::ENOSYS.cast_unsigned()))?;
    if cfg!(target_arch = "x86_64") { install(&no_x32()) } else { Ok(()) }
}

const NAMESPACES: [i32; 8] = [
    libc::CLONE_NEWUSER,
    libc::CLONE_NEWNS,
    libc::CLONE_NEWPID,
    libc::CLONE_NEWNET,
    libc::CLONE_NEWIPC,
    libc::CLONE_NEWUTS,
    libc::CLONE_NEWCGROUP,
    0x80, // CLONE_NEWTIME
];

fn any_of(flags: &[i32]) -> Result<Vec<SeccompRule>, String> {
    let bits = flags.iter().map(|flag| u64::from(flag.cast_unsigned()));
    // The lowest byte holds a signal, so the flag for time is none here.
    bits.filter(|bit| *bit > 0xff).map(|bit| when(0, SeccompCmpOp::MaskedEq(bit), bit)).collect()
}

fn condition(argument: u8, operator: SeccompCmpOp, value: u64) -> Result<SeccompCondition, String> {
    SeccompCondition::new(argument, SeccompCmpArgLen::Dword, operator, value).map_err(|error| error.to_string())
}

fn when(argument: u8, operator: SeccompCmpOp, value: u64) -> Result<SeccompRule, String> {
    SeccompRule::new(vec![condition(argument, operator, value)?]).map_err(|error| error.to_string())
}

/// Limits of another process: 0 is itself.
fn not_itself(own: u64) -> Result<SeccompRule, String> {
    SeccompRule::new(vec![condition(0, SeccompCmpOp::Ne, 0)?, condition(0, SeccompCmpOp::Ne, own)?])
        .map_err(|error| error.to_string())
}

fn apply(rules: Rules, error: u64) -> Result<(), String> {
    let architecture = TargetArch::try_from(ARCH).map_err(|error| error.to_string())?;
    let answer = SeccompAction::Errno(error as u32);
    let filter =
        SeccompFilter::new(rules, SeccompAction::Allow, answer, architecture).map_err(|error| error.to_string())?;
    install(&BpfProgram::try_from(filter).map_err(|error| error.to_string())?)
}

fn install(program: &BpfProgram) -> Result<(), String> {
    apply_filter(program).map_err(|error| error.to_string())
}

/// The same calls have second numbers above 2³⁰ on x86-64. No program needs them.
fn no_x32() -> BpfProgram {
    let step = |code: u32, jt, jf, k| seccompiler::sock_filter { code: code as u16, jt, jf, k };
    vec![
        step(libc::BPF_LD | libc::BPF_W | libc::BPF_ABS, 0, 0, 0),
        step(libc::BPF_JMP | libc::BPF_JGE | libc::BPF_K, 0, 1, 0x4000_0000),
        step(libc::BPF_RET | libc::BPF_K, 0, 0, libc::SECCOMP_RET_ERRNO | libc::EPERM.cast_unsigned()),
        step(libc::BPF_RET | libc::BPF_K, 0, 0, libc::SECCOMP_RET_ALLOW),
    ]
}
