// Table files: the baked tables as a multi-part EXR that any EXR tool opens, with the parameters,
// the version and a checksum of the whole file inside.
//
// Parts of the solver "moments": "optical_depth", "moments", "source"; with the orders kept also
// "moments_order_N", of the light of order N, and "source_order_N", from N = 2, which makes it. Of
// "standard": "optical_depth", "irradiance", "scattering", and "single_mie" unless it is packed;
// with the orders kept also "scattering_order_N", "irradiance_order_N" and "single_mie_order_1".
// All are RGBA, half or float as baked; the optical depth and the moments are float wherever the
// device allows. A 3D table is a 2D image: its slices of r stand below each other, so a part's
// bytes are those of the table's tightly packed copy.
#pragma once

#include <alpenglow/io/result.h>
#include <alpenglow/tables.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace alpenglow::io {

/// The layout of the file; a reader refuses any other, and any other version of the library, since
/// the tables mean what that version's shaders read from them.
inline constexpr int kTableFileFormat = 2;
/// Most texels along a side of a table and in a table; checked before anything is allocated.
inline constexpr uint32_t kMaxTableSide = 4096;
inline constexpr uint64_t kMaxTableTexels = uint64_t{1} << 26;

/// One table, as recordTableReadback leaves it and recordTableUpload takes it.
struct TablePart {
  std::string name;
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t depth = 1;
  TableFormat format = TableFormat::Half;
  std::vector<uint8_t> texels;  ///< Bytes: width x height x depth x RGBA.
};

struct TableFile {
  Parameters parameters;
  TableDesc desc;  ///< As resolved() leaves it.
  std::vector<TablePart> parts;

  /// Null when there is none of this name.
  const TablePart* find(const std::string& name) const;
};

/// The description with defaults in place of the zeros that its solver reads: no quality is
/// Default, no size and no setting 0. Orders 0 stay 0 for Solver::Moments: all of them.
TableDesc resolved(TableDesc desc, const Parameters& parameters);

/// Empty, or a sentence about the first size or setting that is out of bounds. `desc` is resolved.
Done checkSizes(const TableDesc& desc);

/// Numbers of a part in another format; what a half can't hold becomes infinite or 0.
void convertTexels(TablePart* part, TableFormat format);

/// The parts that a file of this description must have, without texels; the optical depth and the
/// moments may have another format than the description.
std::vector<TablePart> expectedParts(const TableDesc& desc);

/// A size as the command line and files spell it: "256x64", "32x128x32x8" (r x mu x mu_s x nu).
std::string transmittanceSizeText(const TableSizes& sizes);
std::string irradianceSizeText(const TableSizes& sizes);
std::string scatteringSizeText(const TableSizes& sizes);
/// False, with `sizes` unchanged, when the string is not whole numbers from 1 to 4096 and "x".
bool parseTransmittanceSize(const std::string& text, TableSizes* sizes);
bool parseIrradianceSize(const std::string& text, TableSizes* sizes);
bool parseScatteringSize(const std::string& text, TableSizes* sizes);

/// Names of the solvers on the command line and in files, in the order of their values.
const std::vector<std::string>& solverNames();
std::string solverName(Solver solver);
std::optional<Solver> findSolver(const std::string& name);

/// Names of the levels of quality, from Quality::Draft on; Quality::Default has no name.
const std::vector<std::string>& qualityNames();
std::string qualityName(Quality quality);
std::optional<Quality> findQuality(const std::string& name);

/// Sizes of Solver::Moments as the command line and files spell them: "nodesR=16,degree=12", those
/// that are not 0. zenithsSky, zenithsLimb and zenithsGround are called ringsSky, ringsLimb and
/// ringsGround.
std::string momentSettingsText(const TableSizes& settings);
/// Takes the fields that the string names, and leaves the others. Each may occur once, from 2 to
/// kMaxTableSide (degree: to 47). Otherwise a sentence, with `settings` unchanged.
Done parseMomentSettings(const std::string& text, TableSizes* settings);

/// Writes the file whole or not at all, and reads it back before it takes its place.
Done writeTableFile(const std::string& path, const TableFile& file);

/// Reads a file, checksum first. Parts of single orders are checked, but kept only if `orders`.
Result<TableFile> readTableFile(const std::string& path, bool orders = false);

}  // namespace alpenglow::io
