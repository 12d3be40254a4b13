#pragma once

#include "config/AcsdConfig.hpp"
#include "replay/CoreRecord.hpp"
#include <acs/acsd/IRobotDriver.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// A file that the configuration names.
struct RecordedFile
{
    std::string name; ///< In the recorded configuration.
    std::string text;
};

/// What a recording begins with.
struct RecordedRun
{
    std::string version; ///< Of acsd.
    std::string config;  ///< TOML
    std::vector<RecordedFile> files;
};

/// The keys of the configuration as TOML: without addresses, paths, headers, names and passwords of the links, which have no effect
/// on the decisions of acsd. Values of keys that are named as secrets are replaced.
[[nodiscard]] std::string MakeRecordedConfig(const AcsdConfig& config);

/// The same for processes whose decisions are the same: a hash of the keys and files that have an effect on them.
[[nodiscard]] std::string MakeConfigFingerprint(const AcsdConfig& config);

/// The first record of a run, with the configuration and the files that it names.
[[nodiscard]] CoreRecord MakeBeginRecord(const AcsdConfig& config, Core::Now now);

/// Reads the text of MakeBeginRecord. Accepts any text.
[[nodiscard]] Core::Result<RecordedRun> DecodeBegin(std::string_view text);

/// Writes the files and the configuration to the folder, which exists, and reads them. Errors are those of the configuration.
[[nodiscard]] AcsdConfig ReadRecordedConfig(
    const RecordedRun& run,
    const std::string& folder,
    const RobotDrivers& drivers);

} // namespace ACS::Acsd
