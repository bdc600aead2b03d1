#include "client-sdk/gateway/operations/opening_hours.hpp"

#include <algorithm>
#include <ctime>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client-sdk/gateway/operations/wake_on_lan.hpp"
#include <mechane/proto/names.hpp>

namespace mechane::gateway {
namespace {

using HoursJson = nlohmann::ordered_json;

constexpr std::array<std::string_view, 7> kDays{"monday", "tuesday",  "wednesday", "thursday",
                                                "friday", "saturday", "sunday"};
constexpr int kMinutesOfDay = 1440;
constexpr int kDaysAhead = 373;

std::tm local_of(std::int64_t at) {
  const std::time_t time = at;
  std::tm out{};
  ::localtime_r(&time, &out);
  return out;
}

/// `days` after the day of `day`, at its minute; what the clock skips counts as the time after the gap.
std::int64_t time_of(const std::tm& day, int days, int minutes) {
  std::tm wanted{};
  wanted.tm_year = day.tm_year;
  wanted.tm_mon = day.tm_mon;
  wanted.tm_mday = day.tm_mday + days;
  wanted.tm_min = minutes;
  wanted.tm_isdst = -1;
  return std::mktime(&wanted);
}

const DayHours& hours_on(const HoursPlan& plan, const std::tm& day) {
  const std::string date = fmt::format("{:04}-{:02}-{:02}", day.tm_year + 1900, day.tm_mon + 1, day.tm_mday);
  const auto exception = plan.exceptions.find(date);
  if (exception != plan.exceptions.end()) return exception->second;
  return plan.week.at(static_cast<std::size_t>((day.tm_wday + 6) % 7));
}

std::string time_text(int minutes) {
  return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

tl::unexpected<Error> wrong_hours(std::string what, const std::string& field, std::string remedy) {
  return fail(ErrorCode::invalid_value, std::move(what), field, std::move(remedy));
}

bool all_digits(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

int number_in(std::string_view digits) {
  int value = 0;
  for (const char c : digits)
    value = 10 * value + (c - '0');
  return value;
}

/// A day that the calendar has, as "2026-12-25".
bool is_date(std::string_view text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  const std::string_view year = text.substr(0, 4), month = text.substr(5, 2), day = text.substr(8, 2);
  if (!all_digits(year) || !all_digits(month) || !all_digits(day) || number_in(year) < 2000) return false;
  std::tm wanted{};
  wanted.tm_year = number_in(year) - 1900;
  wanted.tm_mon = number_in(month) - 1;
  wanted.tm_mday = number_in(day);
  const std::tm asked = wanted;
  ::timegm(&wanted);
  return wanted.tm_year == asked.tm_year && wanted.tm_mon == asked.tm_mon && wanted.tm_mday == asked.tm_mday;
}

Expected<OpenSpan> parse_span(const HoursJson& json, const std::string& field) {
  const auto wrong = [&field] {
    return wrong_hours("these are not opening hours within one day", field,
                       "write \"10:00-18:00\"; split hours past midnight: to 24:00, then from 00:00 the next day");
  };
  if (!json.is_string()) return wrong();
  const auto& text = json.get_ref<const std::string&>();
  const std::size_t dash = text.find('-');
  if (dash == std::string::npos) return wrong();
  const auto from = minutes_of_day(std::string_view(text).substr(0, dash));
  const auto to = minutes_of_day(std::string_view(text).substr(dash + 1));
  if (!from || !to || *from >= *to) return wrong();
  return OpenSpan{*from, *to};
}

Expected<DayHours> parse_day(const HoursJson& json, const std::string& field) {
  if (!json.is_array())
    return wrong_hours("a day's hours are a list", field, R"(write ["10:00-18:00"], or [] for closed)");
  if (json.size() > OpeningHours::kMostSpans)
    return fail(ErrorCode::too_large, "a day has too many hours", field, "write four spans at most");
  DayHours day;
  for (const HoursJson& one : json) {
    auto span = parse_span(one, field);
    if (!span) return tl::unexpected(span.error());
    if (!day.empty() && span->from_min <= day.back().to_min)
      return wrong_hours("the hours overlap, or are not in order", field,
                         "write them in order, with time between them");
    day.push_back(*span);
  }
  return day;
}

Expected<HoursPlan> parse_plan(const HoursJson& json, const std::string& field) {
  if (!json.is_object() || !json.contains("week") || !json["week"].is_object())
    return wrong_hours("the plan has no week", field,
                       R"(write {"week": {"monday": ["10:00-18:00"]}, "exceptions": {}})");
  HoursPlan plan;
  for (const auto& [name, hours] : json["week"].items()) {
    const auto* const day = std::ranges::find(kDays, name);
    if (day == kDays.end())
      return wrong_hours("this is not a day of the week", field + ".week", "write monday to sunday");
    auto parsed = parse_day(hours, fmt::format("{}.week.{}", field, name));
    if (!parsed) return tl::unexpected(parsed.error());
    plan.week.at(static_cast<std::size_t>(day - kDays.begin())) = std::move(*parsed);
  }
  const auto exceptions = json.find("exceptions");
  if (exceptions == json.end()) return plan;
  if (!exceptions->is_object())
    return wrong_hours("exceptions are an object by date", field + ".exceptions", R"(write {"2026-12-25": []})");
  if (exceptions->size() > OpeningHours::kMostExceptions)
    return fail(ErrorCode::too_large, "there are too many exceptions", field + ".exceptions",
                "remove those of the past");
  for (const auto& [date, hours] : exceptions->items()) {
    if (!is_date(date))
      return wrong_hours("this is not a date", field + ".exceptions", "write the year, month and day: 2026-12-25");
    auto parsed = parse_day(hours, fmt::format("{}.exceptions.{}", field, date));
    if (!parsed) return tl::unexpected(parsed.error());
    plan.exceptions[date] = std::move(*parsed);
  }
  return plan;
}

/// The member: an object whose keys are names of kiosks. An empty object where it is missing.
Expected<HoursJson> by_kiosk(const HoursJson& json, const char* member) {
  const auto found = json.find(member);
  if (found == json.end()) return HoursJson::object();
  if (!found->is_object()) return wrong_hours("this is an object by kiosk", member, R"(write {"kiosk-1": ...})");
  if (found->size() > OpeningHours::kMostKiosks)
    return fail(ErrorCode::too_large, "there are too many kiosks", member, "name a hundred at most");
  for (const auto& [kiosk, unused] : found->items())
    if (auto named = proto::check_name(kiosk, member); !named) return tl::unexpected(named.error());
  return *found;
}

HoursJson day_json(const DayHours& day) {
  HoursJson out = HoursJson::array();
  for (const OpenSpan& span : day)
    out.push_back(time_text(span.from_min) + "-" + time_text(span.to_min));
  return out;
}

HoursJson plan_json(const HoursPlan& plan) {
  HoursJson week = HoursJson::object(), exceptions = HoursJson::object();
  for (std::size_t day = 0; day < kDays.size(); ++day)
    week[std::string(kDays.at(day))] = day_json(plan.week.at(day));
  for (const auto& [date, hours] : plan.exceptions)
    exceptions[date] = day_json(hours);
  return {{"week", week}, {"exceptions", exceptions}};
}

}  // namespace

std::optional<int> minutes_of_day(std::string_view text) {
  if (text.size() != 5 || text[2] != ':') return std::nullopt;
  if (!all_digits(text.substr(0, 2)) || !all_digits(text.substr(3))) return std::nullopt;
  const int hours = number_in(text.substr(0, 2)), minutes = number_in(text.substr(3));
  if (minutes > 59 || hours * 60 + minutes > kMinutesOfDay) return std::nullopt;
  return hours * 60 + minutes;
}

Expected<OpeningHours> parse_hours(std::string_view text) {
  const HoursJson json = HoursJson::parse(text, nullptr, false);
  if (!json.is_object()) return wrong_hours("these hours are not a JSON object", "hours", "send an object");
  OpeningHours hours;
  if (const auto museum = json.find("museum"); museum != json.end() && !museum->is_null()) {
    auto plan = parse_plan(*museum, "museum");
    if (!plan) return tl::unexpected(plan.error());
    hours.museum = std::move(*plan);
  }
  const auto kiosks = by_kiosk(json, "kiosks");
  if (!kiosks) return tl::unexpected(kiosks.error());
  for (const auto& [kiosk, one] : kiosks->items()) {
    auto plan = parse_plan(one, "kiosks." + kiosk);
    if (!plan) return tl::unexpected(plan.error());
    hours.kiosks[kiosk] = std::move(*plan);
  }
  const auto wake = by_kiosk(json, "wake");
  if (!wake) return tl::unexpected(wake.error());
  for (const auto& [kiosk, mac] : wake->items()) {
    const auto address = mac.is_string() ? parse_mac(mac.get<std::string>()) : std::nullopt;
    if (!address)
      return wrong_hours("this is not a MAC address", "wake." + kiosk,
                         "write six pairs of hex digits: 02:00:5e:10:00:01");
    hours.wake[kiosk] = mac_text(*address);
  }
  return hours;
}

std::string hours_text(const OpeningHours& hours) {
  HoursJson kiosks = HoursJson::object(), wake = HoursJson::object();
  for (const auto& [kiosk, plan] : hours.kiosks)
    kiosks[kiosk] = plan_json(plan);
  for (const auto& [kiosk, mac] : hours.wake)
    wake[kiosk] = mac;
  return HoursJson{
      {"museum", hours.museum ? plan_json(*hours.museum) : HoursJson()}, {"kiosks", kiosks}, {"wake", wake}}
      .dump();
}

const HoursPlan* plan_of(const OpeningHours& hours, const std::string& kiosk) {
  if (const auto own = hours.kiosks.find(kiosk); own != hours.kiosks.end()) return &own->second;
  return hours.museum ? &*hours.museum : nullptr;
}

bool is_open(const HoursPlan& plan, std::int64_t at) {
  const std::tm local = local_of(at);
  const int minute = 60 * local.tm_hour + local.tm_min;
  return std::ranges::any_of(hours_on(plan, local), [minute](const OpenSpan& span) {
    return minute >= span.from_min && minute < span.to_min;
  });
}

std::optional<std::int64_t> next_change(const HoursPlan& plan, std::int64_t at) {
  const bool before = is_open(plan, at);
  const std::tm today = local_of(at);
  for (int day = 0; day < kDaysAhead; ++day) {
    // Noon is on the day that is meant, however the clock is set.
    const std::tm noon = local_of(time_of(today, day, 12 * 60));
    std::vector<int> minutes{0, 60, 120, 180};  // the clock may be set at night, and the state with it
    for (const OpenSpan& span : hours_on(plan, noon))
      minutes.insert(minutes.end(), {span.from_min, span.to_min});
    std::vector<std::int64_t> times;
    for (const int minute : minutes)
      for (const std::int64_t shift : {-3600, 0, 3600})  // an hour that the clock shows twice
        times.push_back(time_of(today, day, minute) + shift);
    std::ranges::sort(times);
    for (const std::int64_t time : times)
      if (time > at && is_open(plan, time) != before) return time;
  }
  return std::nullopt;
}

std::int64_t next_at(int minutes, std::int64_t at) {
  const std::tm today = local_of(at);
  for (int day = 0;; ++day)
    if (const std::int64_t time = time_of(today, day, minutes); time > at) return time;
}

}  // namespace mechane::gateway
