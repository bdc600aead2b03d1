// A file of visits may come on a stick from another museum: whatever its bytes, it gives valid records of visits, or an error.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "client-sdk/cli/visit_plot.hpp"
#include "client-sdk/cli/visit_text.hpp"
#include "server/visits/remark_book.hpp"
#include "server/visits/visit_csv.hpp"
#include "server/visits/visit_file.hpp"

namespace {

namespace cli = mechane::cli;
using mechane::visits::VisitFile;

/// One file for all inputs of a run, in memory where possible; it is deleted at the end of the program.
struct VisitsFile {
  VisitsFile() {
    const bool memory = access("/dev/shm", W_OK) == 0;
    const std::filesystem::path folder = memory ? "/dev/shm" : std::filesystem::temp_directory_path();
    path = folder / fmt::format("mechane-visits-fuzz-{}.db", getpid());
  }
  VisitsFile(const VisitsFile&) = delete;
  VisitsFile& operator=(const VisitsFile&) = delete;
  ~VisitsFile() { remove(); }
  /// With what SQLite keeps beside it: an input is one file.
  void remove() const {
    std::error_code ignored;
    for (const char* beside : {"", "-wal", "-shm"})
      std::filesystem::remove(path.string() + beside, ignored);
  }
  std::filesystem::path path;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const auto remarks = mechane::visits::parse_remarks({reinterpret_cast<const char*>(data), size})) {
    for (const auto& [number, of_visit] : *remarks)
      for (const auto& remark : of_visit)
        if (!mechane::visits::check_remark(remark, number)) std::abort();
  }
  static const VisitsFile file;
  file.remove();
  std::ofstream(file.path, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto visits = VisitFile::open(file.path, VisitFile::Access::read);
  if (!visits) return 0;
  const auto records = visits->records({});
  if (!records) return 0;
  for (const auto& record : *records) {
    if (record.number.size() != 14 || !(record.duration_s >= 0) || record.minute < 0) std::abort();
    for (const auto& answer : record.answers) {
      if (answer.mark > answer.marks || (answer.marks > 0 && answer.mark < 1)) std::abort();
    }
  }
  const auto activities = mechane::visits::summarise(*records);
  if (cli::visits_report(activities).empty() || cli::report_json(activities).empty()) std::abort();
  if (mechane::visits::visits_csv(*records).empty() || cli::visits_list(*records).empty()) std::abort();
  if (cli::visits_svg(activities).find('\x1b') != std::string::npos) std::abort();
  return 0;
}
