// The tables that bake, render and probe work with: baked here, or loaded from a file.
#pragma once

#include <alpenglow/io/scene_file.h>
#include <alpenglow/io/table_file.h>

#include "arguments.h"
#include "session.h"

namespace alpenglow::cli {

/// The description that options ask for, over the scene's if there is one, resolved. Throws a
/// Failure for sizes out of bounds and for options of the other solver.
TableDesc describeTables(const TableArguments& arguments, const Parameters& parameters,
                         const io::Scene* scene);

/// What options and scene give of a description, and nothing else: for planScene.
TableDesc describeBase(const TableArguments& arguments, const io::Scene& scene);

/// Bakes in slices with a progress bar. With `kept`, desc.keepOrders must be set; each order's
/// tables are appended to it.
TablesPointer bakeTables(Session* session, const Parameters& parameters, const TableDesc& desc,
                         std::vector<io::TablePart>* kept);

/// Copies the finished tables to the host, in the order of a table file.
std::vector<io::TablePart> readTables(Session* session, Tables* tables, const TableDesc& desc);

/// Tables ready for use, and what they are.
struct ReadyTables {
  TablesPointer tables;
  TableDesc desc;
};

/// What render and probe want, checked before there is a device: a description, or the file that
/// --tables names, which is for these parameters and agrees with the options that were given.
struct TableRequest {
  TableDesc desc;
  std::optional<io::TableFile> file;
};
/// Throws a Failure.
TableRequest requestTables(const TableArguments& arguments, const Parameters& parameters,
                           const io::Scene* scene);
ReadyTables obtainTables(Session* session, const Parameters& parameters, TableRequest request);

}  // namespace alpenglow::cli
