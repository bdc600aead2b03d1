// The node types of X3D 4.0 as text, one a line: read by x3d_schema.cpp alone.
//
//   Name@container:Base,Interface field:Type[least,most]=default +slot*:Type|Type
//
// `container` is the field of the parent that a node fills where containerField is not written. A field's range may be open at an end
// ("(0,]": above 0, no upper end). Blanks of a default are commas. A slot is a field that holds nodes, many with a star. Lines that
// begin with blanks go on with the line before.
#pragma once

#include <string_view>

namespace mechane::scenario {

extern const std::string_view kX3dCore;
extern const std::string_view kX3dMore;

}  // namespace mechane::scenario
