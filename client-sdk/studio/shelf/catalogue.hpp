// All that the museum has, to be searched: exhibits and drafts, their meshes and sounds, and the library.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "client-sdk/studio/draft/draft_files.hpp"
#include "client-sdk/studio/shelf/records.hpp"
#include "server/base/error.hpp"
#include "server/state/description.hpp"

namespace mechane::studio {

enum class ItemKind : std::uint8_t { exhibit, a_template, part, mesh, sound };

struct CatalogueItem {
  ItemKind kind = ItemKind::exhibit;
  std::string name{};
  std::string path{};        ///< from the museum's folder; empty: it is of the library
  std::string exhibit{};     ///< whose file it is; empty: nobody's alone
  state::Texts title{};      ///< of an exhibit, and in the library
  std::uintmax_t bytes = 0;  ///< 0: of the library
  bool published = false;
  bool draft = false;  ///< of an exhibit: it has one; of a file: an exhibit's draft has it
  Record about{};
  std::vector<FileUse> uses{};
  std::string words{};  ///< more words by which it is found: DEFs
};

/// Empty: all.
struct CatalogueQuery {
  std::string text{};      ///< words; each must be in it somewhere, see folded()
  std::string kind{};      ///< exhibit, draft, template, part, mesh, sound
  std::string tag{};       ///< as folded()
  std::string licence{};   ///< "-": it has none
  std::string language{};  ///< a code
};

/// Errors: invalid_value, of an unknown kind, or of a text of more than 500 bytes.
[[nodiscard]] Expected<void> check_query(const CatalogueQuery& query);
/// The kind in the answer: "mesh".
[[nodiscard]] std::string_view word_of(ItemKind kind);
[[nodiscard]] bool fits(const CatalogueItem& item, const CatalogueQuery& query);
/// The answer of COMMANDS.md: what fits, and what can be chosen among all. `notice`: why records are missing.
[[nodiscard]] std::string catalogue_json(std::span<const CatalogueItem> items, const CatalogueQuery& query,
                                         const Error* notice);

}  // namespace mechane::studio
