// Mesh files as objects to be grasped: the product's own models, and whatever else lies at hand.
#pragma once

#include <filesystem>
#include <vector>

#include "server/base/error.hpp"
#include "tests/benchmark/collision/scene.hpp"

namespace mechane::benchmark {

/// The bodies of a model whose nodes name their parts, each in its node's frame, of its true size; or, without such nodes, the whole
/// file as one thing without a unit, made as long as a thing that a hand holds. With
/// `finest_m`, walls are cut where they enter another part (see cut_air_side). Errors: those of the import.
[[nodiscard]] Expected<std::vector<SceneObject>> load_models(const std::filesystem::path& file, double finest_m = 0);

}  // namespace mechane::benchmark
