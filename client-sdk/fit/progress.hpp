// Shows the progress of building parts: a bar on a terminal, otherwise a plain line from time to time.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>

namespace mechane::fit {

struct Stage {
  std::string mesh;  ///< "screw.glb"
  std::string what;  ///< "building parts"
  std::size_t done = 0;
  std::size_t total = 0;  ///< 0: unknown
};

/// "screw.glb  [######......] 12/57 building parts, 8 s", at most `columns` wide.
[[nodiscard]] std::string bar_line(const Stage& stage, double seconds, std::size_t columns);

/// "screw.glb: building parts, 12 of 57, 8 s"
[[nodiscard]] std::string plain_line(const Stage& stage, double seconds);

/// Owns a thread that draws. All functions may be called from any thread.
class Progress {
 public:
  /// A bar if `out` is a terminal, redrawn ten times a second; otherwise a line every five seconds.
  explicit Progress(std::FILE* out);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void begin(Stage stage);
  /// Ignores a smaller count: threads may report out of order.
  void advance(std::size_t done, std::size_t total);
  void end();  ///< removes the bar, so that other text can be written

 private:
  void run();
  void draw();  // with mutex_ held

  std::FILE* out_;
  bool terminal_;
  std::mutex mutex_;  // guards all below
  std::condition_variable changed_;
  Stage stage_;
  double began_s_ = 0;
  bool active_ = false;
  bool leave_ = false;
  std::thread thread_;
};

}  // namespace mechane::fit
