#pragma once

#include "commands/CommandError.hpp"
#include "http/IApi.hpp"
#include <acs/core/Now.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::Acsctl
{

/// What an answer consists of.
enum class EContent : std::uint8_t
{
    Json,  ///< One JSON object.
    Lines, ///< JSON objects, one on each line.
    Text,
};

/// What a bundle shall contain: a file and the GET that it is read with.
struct BundlePart
{
    std::string fileName;
    std::string target;
    EContent content = EContent::Json;
};

/// A finished bundle.
struct SupportBundle
{
    std::string archive;              ///< .tar.gz
    std::string manifest;             ///< JSON: also a file of the archive.
    std::vector<std::string> missing; ///< Files that are not in it, with the reason.
    bool bForeign = false;            ///< An answer was not that of its route: another server answered.
};

/// The parts of the operator API.
[[nodiscard]] std::vector<BundlePart> ListBundleParts();
/// The parts at http.listen.
[[nodiscard]] std::vector<BundlePart> ListHttpParts();

/// Collects the parts. A part that cannot be read, or whose answer is not what its route has, is listed in the manifest; an error
/// only if the status cannot be read. The second API is that of http.listen, nullptr: none. No header of a request is in the
/// bundle, hence no token.
[[nodiscard]] Outcome<SupportBundle> CollectBundle(
    IApi& api,
    IApi* httpOrNull,
    const std::string& url,
    Core::WallTime now);

} // namespace ACS::Acsctl
