#include "client-sdk/studio/shelf_fault.hpp"

#include <nlohmann/json.hpp>

#include "client-sdk/studio/view.hpp"

namespace mechane::studio {

std::string fault_json(const ShelfFault& fault) {
  nlohmann::json out{{"error", fault.error.what}, {"remedy", fault.error.remedy}};
  if (!fault.error.where.empty()) out["place"] = fault.error.where;
  if (fault.error.line > 0) out["line"] = fault.error.line;
  if (fault.revision) out["revision"] = *fault.revision;
  if (fault.command) out["command"] = *fault.command;
  for (const FileUse& use : fault.uses)
    out["uses"].push_back({{"place", use.place}, {"line", use.line}});
  if (!fault.problems.empty()) out["problems"] = nlohmann::json::parse(problems_json(nullptr, fault.problems));
  return out.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace mechane::studio
