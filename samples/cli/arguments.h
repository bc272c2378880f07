// What the command line gave, and how its options are declared.
#pragma once

#include <alpenglow/tables.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

namespace alpenglow::cli {

/// Choices about the tables; what was not given is empty.
struct TableArguments {
  std::optional<std::string> solver;
  std::optional<std::string> orders;
  std::optional<std::string> quality;
  std::optional<std::string> moments;
  std::optional<std::string> sizeTransmittance;
  std::optional<std::string> sizeIrradiance;
  std::optional<std::string> sizeScattering;
  std::optional<std::string> format;
  std::optional<std::string> mie;
  std::string tables;  ///< Of render and probe: a table file to load.
  bool keepOrders = false;

  /// The name of the first option about what tables hold that was given, for sentences.
  const char* firstTableOption() const;
  /// Throws a usage Failure when an option of the other solver was given; `why` is the clause that
  /// says why it is this one, such as "--solver standard was given".
  void checkBelongTo(Solver chosen, const std::string& why) const;
};

/// Where the work runs and what is written about it.
struct RunArguments {
  std::string device;
  std::string output;
  std::string report;
};

struct BakeArguments {
  std::string atmosphere;
  TableArguments tables;
  RunArguments run;
};

struct RenderArguments {
  std::string scene;
  std::string flythrough;  ///< Instead of a scene.
  std::optional<std::string> imageFormat;
  std::optional<std::string> frames;
  std::string size;
  std::optional<std::string> shafts;
  std::optional<std::string> lightShaftStepCount;
  TableArguments tables;
  RunArguments run;
};

struct ExplainArguments {
  std::string scene;
  bool json = false;
};

struct ProbeArguments {
  std::string atmosphere;
  std::string queries;
  std::string method = "tables";
  std::optional<std::string> samples;
  TableArguments tables;
  RunArguments run;
};

struct CostArguments {
  std::string folder;
  std::string device;
  bool quick = false;
};

/// `keepOrdersHelp` says what becomes of the orders that --keep-orders keeps.
void addTableOptions(CLI::App* command, const std::string& keepOrdersHelp,
                     TableArguments* arguments);
void addTableFileOption(CLI::App* command, TableArguments* arguments);
void addRunOptions(CLI::App* command, const std::string& outputHelp, RunArguments* arguments);
void addSizeOption(CLI::App* command, std::string* size);
void addFlythroughOptions(CLI::App* command, RenderArguments* arguments);
void addLightShaftOptions(CLI::App* command, RenderArguments* arguments);
void addMethodOptions(CLI::App* command, ProbeArguments* arguments);

/// Whole numbers of a text that an option's check has accepted.
uint32_t parseOrders(const std::string& text);
uint64_t parseSamples(const std::string& text);
void parsePictureSize(const std::string& text, uint32_t* width, uint32_t* height);

}  // namespace alpenglow::cli
