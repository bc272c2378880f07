// Prints a scene's plan, for people and as JSON.
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "common/sample_files.h"
#include "common/scene_plan.h"
#include "failure.h"

namespace alpenglow::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string bytesText(uint64_t bytes) {
  char text[32];
  const double megabytes = static_cast<double>(bytes) / 1e6;
  std::snprintf(text, sizeof text, megabytes < 0.1 ? "%.3f MB" : "%.1f MB", megabytes);
  return text;
}

std::string savedText(const PlanCost& saves) {
  std::string text;
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
  if (saves.bytes > 0) add(bytesText(saves.bytes));
  if (saves.images > 0) add(std::to_string(saves.images) + " images");
  if (saves.pipelines > 0) add(std::to_string(saves.pipelines) + " pipelines");
  if (saves.dispatches > 0) add(std::to_string(saves.dispatches) + " dispatches");
  if (saves.units > 0) {
    char units[48];
    std::snprintf(units, sizeof units, "%.3g units of a bake", static_cast<double>(saves.units));
    add(units);
  }
  return text.empty() ? "" : " Saves " + text + ".";
}

void printEffects(const Plan& plan) {
  std::cout << "Effects\n";
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const PlanChoice& choice = plan.choices[i];
    char head[64];
    std::snprintf(head, sizeof head, "  %-20s %-4s", effectName(static_cast<Effect>(i)),
                  choice.on ? "on" : "off");
    std::cout << head << choice.reason << savedText(choice.saves) << '\n';
  }
}

void printChoices(const Plan& plan) {
  std::cout << "\nChoices\n";
  for (uint32_t i = kEffectCount; i < plan.choiceCount; ++i) {
    const PlanChoice& choice = plan.choices[i];
    char head[160];
    std::snprintf(head, sizeof head, "  %-11s %s: ", choice.name, choice.value);
    std::cout << head << choice.reason << savedText(choice.saves) << '\n';
  }
}

void printTables(const Plan& plan) {
  std::cout << "\nImages that stay\n";
  for (uint32_t i = 0; i < plan.imageCount; ++i) {
    const ImageInfo& table = plan.images[i];
    char line[96];
    std::snprintf(line, sizeof line, "  %-15s %4u x %4u x %3u  %s\n", table.name,
                  table.extent.width, table.extent.height, table.extent.depth,
                  bytesText(table.bytes).c_str());
    std::cout << line;
  }
}

void printTotals(const Plan& plan) {
  char text[200];
  std::snprintf(text, sizeof text,
                "\n%s instead of %s, %llu pipelines of %llu, %.3g units of a bake of %.3g.\n",
                bytesText(plan.cost.bytes).c_str(), bytesText(plan.whole.bytes).c_str(),
                static_cast<unsigned long long>(plan.cost.pipelines),
                static_cast<unsigned long long>(plan.whole.pipelines),
                static_cast<double>(plan.cost.units), static_cast<double>(plan.whole.units));
  std::cout << text;
  if (plan.expectedError > 0.0) {
    std::snprintf(text, sizeof text, "Expected error: %.2f %%, 95th percentile, %s.\n",
                  100.0 * plan.expectedError,
                  plan.errorMet ? "within what is wanted" : "more than is wanted");
    std::cout << text;
  }
  if (!plan.budgetMet) std::cout << "The budget is exceeded.\n";
}

Json costJson(const PlanCost& cost) {
  return {{"bytes", cost.bytes},   {"bake_bytes", cost.bakeBytes}, {"dispatches", cost.dispatches},
          {"texels", cost.texels}, {"pipelines", cost.pipelines},  {"images", cost.images},
          {"units", cost.units}};
}

Json planJson(const Plan& plan) {
  Json root;
  root["effects"] = Json::array();
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const PlanChoice& choice = plan.choices[i];
    root["effects"].push_back({{"name", effectName(static_cast<Effect>(i))},
                               {"on", choice.on},
                               {"forced", choice.forced},
                               {"reason", choice.reason},
                               {"saves", costJson(choice.saves)}});
  }
  root["choices"] = Json::array();
  for (uint32_t i = kEffectCount; i < plan.choiceCount; ++i) {
    const PlanChoice& choice = plan.choices[i];
    root["choices"].push_back({{"name", choice.name},
                               {"value", choice.value},
                               {"reason", choice.reason},
                               {"saves", costJson(choice.saves)}});
  }
  root["tables"] = Json::array();
  for (uint32_t i = 0; i < plan.imageCount; ++i) {
    const ImageInfo& table = plan.images[i];
    root["tables"].push_back(
        {{"name", table.name},
         {"size", {table.extent.width, table.extent.height, table.extent.depth}},
         {"bytes", table.bytes}});
  }
  root["expected_error"] = plan.expectedError;
  root["error_met"] = plan.errorMet;
  root["budget_met"] = plan.budgetMet;
  root["cost"] = costJson(plan.cost);
  root["default_cost"] = costJson(plan.whole);
  return root;
}

}  // namespace

void runExplain(const ExplainArguments& arguments) {
  const io::Scene scene = take(io::readScene(samples::findSample("scenes", arguments.scene)));
  const Plan plan = samples::planScene(scene, samples::tablesOf(scene));
  if (arguments.json) {
    std::cout << planJson(plan).dump(2) << '\n';
    return;
  }
  printEffects(plan);
  printChoices(plan);
  printTables(plan);
  printTotals(plan);
}

}  // namespace alpenglow::cli
