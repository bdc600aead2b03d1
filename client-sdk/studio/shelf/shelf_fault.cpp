#include "client-sdk/studio/shelf/shelf_fault.hpp"

#include "client-sdk/studio/shelf/shelf_text.hpp"
#include "client-sdk/studio/view/view.hpp"

namespace mechane::studio {

std::string fault_json(const ShelfFault& fault) {
  ShelfJson out{{"error", fault.error.what}, {"remedy", fault.error.remedy}};
  if (!fault.error.where.empty()) out["place"] = fault.error.where;
  if (fault.error.line > 0) out["line"] = fault.error.line;
  if (fault.revision) out["revision"] = *fault.revision;
  if (fault.command) out["command"] = *fault.command;
  if (!fault.uses.empty()) out["uses"] = json_of(fault.uses);
  if (!fault.problems.empty()) out["problems"] = ShelfJson::parse(problems_json(nullptr, fault.problems));
  return shelf_text(out);
}

}  // namespace mechane::studio
