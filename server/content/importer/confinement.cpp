#include "server/content/importer/confinement.hpp"

#include <cerrno>
#include <cstddef>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include "server/base/sanitized.hpp"

namespace mechane::content {
namespace {

bool limit(int resource, std::uint64_t soft, std::uint64_t hard) {
  const rlimit wanted{soft, hard};
  return setrlimit(static_cast<__rlimit_resource_t>(resource), &wanted) == 0;
}

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#endif

constexpr sock_filter load(std::size_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}
constexpr sock_filter answer(std::uint32_t action) {
  return BPF_STMT(BPF_RET | BPF_K, action);
}
/// Comparisons leave out `then` or `otherwise` of the instructions that follow.
constexpr sock_filter if_equal(std::uint32_t value, std::uint8_t then, std::uint8_t otherwise) {
  return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, then, otherwise);
}
constexpr sock_filter if_any_bit(std::uint32_t bits, std::uint8_t then, std::uint8_t otherwise) {
  return BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, then, otherwise);
}

constexpr std::uint32_t kRefused[] = {
    __NR_execve,
    __NR_execveat,
    __NR_clone,
    __NR_socket,
    __NR_socketpair,
    __NR_connect,
    __NR_ptrace,
    __NR_process_vm_readv,
    __NR_process_vm_writev,
    __NR_kill,
    __NR_tgkill,
    __NR_unlinkat,
    __NR_renameat2,
    __NR_mkdirat,
#if defined(__x86_64__)
    __NR_open,  // libc opens through openat
    __NR_creat,
    __NR_fork,
    __NR_vfork,
    __NR_unlink,
    __NR_rename,
    __NR_mkdir,
#endif
};
/// "Not on this kernel": libc then falls back on the call that the filter can judge.
constexpr std::uint32_t kUnknown[] = {__NR_clone3, __NR_openat2};

/// Refuses a few system calls and lets the others through: a list of what is allowed would break with each new libc.
[[maybe_unused]] bool refuse_system_calls() {
  constexpr std::size_t kOpenFlags =
      offsetof(seccomp_data, args) + 2 * sizeof(std::uint64_t);  // third of openat; its low half
  constexpr std::uint32_t kWrites = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
  std::vector<sock_filter> filter{load(offsetof(seccomp_data, arch)), if_equal(kArchitecture, 1, 0),
                                  answer(SECCOMP_RET_KILL_PROCESS), load(offsetof(seccomp_data, nr))};
  for (const std::uint32_t call : kRefused)
    filter.insert(filter.end(), {if_equal(call, 0, 1), answer(SECCOMP_RET_ERRNO | EPERM)});
  for (const std::uint32_t call : kUnknown)
    filter.insert(filter.end(), {if_equal(call, 0, 1), answer(SECCOMP_RET_ERRNO | ENOSYS)});
  filter.insert(filter.end(), {if_equal(__NR_openat, 0, 3), load(kOpenFlags), if_any_bit(kWrites, 0, 1),
                               answer(SECCOMP_RET_ERRNO | EPERM), answer(SECCOMP_RET_ALLOW)});
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace

bool confine_this_process(std::uint64_t memory_bytes, std::uint32_t cpu_seconds) {
  bool done = limit(RLIMIT_CORE, 0, 0) && limit(RLIMIT_CPU, cpu_seconds, cpu_seconds + 1U) &&
              limit(RLIMIT_NOFILE, 32, 32) && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
  if constexpr (!kSanitized) {
    done = done && limit(RLIMIT_AS, memory_bytes, memory_bytes);
#if defined(__x86_64__) || defined(__aarch64__)
    done = done && refuse_system_calls();
#endif
  }
  return done;
}

}  // namespace mechane::content
