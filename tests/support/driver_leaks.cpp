/// Linked into the tests that draw. Mesa keeps some memory until the process ends, and its drivers are unloaded before leaks are looked
/// for: what is theirs cannot be told from ours by then. Other errors are still found.
extern "C" int __lsan_is_turned_off();  // NOLINT(bugprone-reserved-identifier): the sanitizer's name
extern "C" int __lsan_is_turned_off() {
  return 1;
}
