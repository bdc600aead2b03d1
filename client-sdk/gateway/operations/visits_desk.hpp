// VisitsDesk: the server's records of visits and observers' remarks, for the operator's API.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "client-sdk/gateway/http/http_types.hpp"
#include "client-sdk/gateway/operations/visits_query.hpp"
#include "server/base/clock.hpp"
#include "server/base/worker.hpp"
#include "server/visits/remark_book.hpp"

namespace mechane::gateway {

/// What a question finds.
struct VisitsFound {
  VisitsQuery query;
  std::int64_t since = 0;                    ///< the first minute that counts, since 1970 UTC
  std::int64_t now = 0;                      ///< the last one
  std::vector<visits::VisitRecord> records;  ///< that fit the query, sorted by minute, with all remarks
  std::vector<std::string> exhibits;         ///< of all visits in this time: what can be asked for
  std::vector<std::string> languages;
  bool cut = false;  ///< there are more visits than are read: the oldest are left out
};

/// Owns a thread, which alone reads files: the records are the server's, and never written here; remarks lie in the gateway's own folder.
/// What was read is kept until the file changes, and a file that changes all the time is read again for a tenth of the time at most. The
/// functions are for the loop's thread, and do not wait.
class VisitsDesk {
 public:
  static constexpr std::size_t kMostVisits = 20'000;
  using Post = std::function<void(std::function<void()>)>;

  /// `records`: empty where the gateway has none. `post` runs a job on the loop's thread.
  VisitsDesk(const std::filesystem::path& records, const std::filesystem::path& state, Post post);

  /// `done` gets what `answer` makes, on the desk's thread, of the visits.
  void read(const VisitsQuery& query, std::function<HttpAnswer(const VisitsFound&)> answer, Site::Done done);
  /// `then` gets the visit, with all remarks, on the loop's thread. Errors: not_found and unknown_name; busy; those of the file.
  void find(const std::string& number, std::function<void(Expected<visits::VisitRecord>)> then);
  /// Keeps a remark about a visit; the answer has all of this visit's remarks. `number`: as a browser wrote it.
  void remark(const std::string& number, const visits::RecordedRemark& remark, Site::Done done);

 private:
  struct Kept {
    std::int64_t days = 0;
    std::string stamp;  ///< of the file and what SQLite keeps beside it
    TimePoint read;
    Duration took{0};
    std::vector<visits::VisitRecord> records;
  };
  void give(std::function<HttpAnswer()> work, Site::Done done);
  // On the thread.
  [[nodiscard]] Expected<VisitsFound> find_now(const VisitsQuery& query);
  [[nodiscard]] Expected<visits::VisitRecord> visit_now(const std::string& number) const;
  [[nodiscard]] Expected<void> look_again(std::int64_t days, std::int64_t since);
  [[nodiscard]] Expected<visits::RemarkBook*> book();
  [[nodiscard]] HttpAnswer remark_now(const std::string& number, const visits::RecordedRemark& remark);

  const std::filesystem::path file_;  ///< empty: there are no records
  const std::filesystem::path remarks_;
  const Post post_;
  std::size_t waiting_ = 0;  ///< for the loop's thread
  // For the thread.
  std::optional<Kept> kept_;
  std::optional<visits::RemarkBook> book_;
  Worker thread_{"gateway-visits"};  ///< last: it ends before what it uses
};

}  // namespace mechane::gateway
