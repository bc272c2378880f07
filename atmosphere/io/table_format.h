// Code that the writer and the reader of table files share.
#pragma once

#include <alpenglow/io/table_file.h>

#include <cstddef>
#include <optional>
#include <string>

namespace alpenglow::io {

// Attributes of the first part. EXR allows 31 characters.
inline constexpr const char* kFormatAttribute = "alpenglow:format";
inline constexpr const char* kVersionAttribute = "alpenglow:version";
inline constexpr const char* kAtmosphereAttribute = "alpenglow:atmosphere";
inline constexpr const char* kSolverAttribute = "alpenglow:solver";
inline constexpr const char* kOrdersAttribute = "alpenglow:orders";
inline constexpr const char* kTexelsAttribute = "alpenglow:texels";
inline constexpr const char* kQualityAttribute = "alpenglow:quality";
inline constexpr const char* kMomentsAttribute = "alpenglow:moments";
inline constexpr const char* kMieAttribute = "alpenglow:mie";
inline constexpr const char* kTransmittanceAttribute = "alpenglow:size_transmittance";
inline constexpr const char* kIrradianceAttribute = "alpenglow:size_irradiance";
inline constexpr const char* kScatteringAttribute = "alpenglow:size_scattering";
inline constexpr const char* kChecksumAttribute = "alpenglow:checksum";
inline constexpr size_t kChecksumDigits = 16;

/// Where the checksum's digits stand in the bytes of a file; none when it has no such attribute.
std::optional<size_t> findChecksum(const std::string& bytes);

/// XXH64 of the bytes with the digits at `digits` taken as '0', as 16 hexadecimal digits. The bytes
/// are the same afterwards.
std::string checksum(std::string* bytes, size_t digits);

/// Empty, or a sentence about the first setting that is not from 2 to kMaxTableSide or kMaxDegree.
Done checkMomentSettings(const TableSizes& settings);

/// Bytes that the texels of a part must have.
size_t expectedBytes(const TablePart& part);

/// Whether a part may have its format: that of the description, except for those that are float
/// wherever the device allows.
bool mayHaveFormat(const TablePart& part, const TableDesc& desc);

/// Shape of a part of a single order, without texels; none when no order's part has this name.
std::optional<TablePart> orderPart(const TableDesc& desc, const std::string& name);

/// Reads from bytes in memory, which are patched and restored on the way. `path` is for sentences.
Result<TableFile> readTableBytes(const std::string& path, std::string* bytes, bool orders);

}  // namespace alpenglow::io
