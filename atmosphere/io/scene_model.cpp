#include "atmosphere/io/scene_model.h"
#include <alpenglow/table_limits.h>

namespace alpenglow::io {

const std::vector<std::string>& modelNames() {
  static const std::vector<std::string> kNames = {"bruneton", "single",      "hoffman-preetham",
                                                  "oneil",    "schafhitzel", "hillaire"};
  return kNames;
}

std::string modelName(SceneModel model) { return modelNames().at(static_cast<size_t>(model)); }

std::optional<Solver> solverOf(SceneModel model) {
  switch (model) {
    case SceneModel::HoffmanPreetham:
      return Solver::HoffmanPreetham;
    case SceneModel::ONeil:
      return Solver::ONeil;
    case SceneModel::Schafhitzel:
      return Solver::Schafhitzel;
    case SceneModel::Hillaire:
      return Solver::Hillaire;
    default:
      return std::nullopt;
  }
}

void readModel(JsonErrors* errors, ObjectReader* reader, Scene* scene) {
  scene->model = static_cast<SceneModel>(reader->choice("model", modelNames()));
  if (!errors->ok()) return;
  const std::string because = "left out, because the model is " + modelName(scene->model);
  if (solverOf(scene->model)) {
    if (scene->solver) reader->wrong("solver", because);
    if (scene->orders) reader->wrong("orders", because);
    if (scene->quality) reader->wrong("quality", because);
  }
  if (scene->model == SceneModel::Single) {
    if (scene->orders.value_or(1) != 1) reader->wrong("orders", "1, because the model is single");
    scene->orders = 1;
  }
  if (!reader->given("model_samples")) return;
  scene->modelStepCount = reader->integer("model_samples", 1, kMaxStepCount);
  if (scene->model != SceneModel::ONeil && scene->model != SceneModel::Hillaire) {
    reader->wrong("model_samples", because);
  }
}

}  // namespace alpenglow::io
