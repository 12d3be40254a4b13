#pragma once

#include "commands/CommandError.hpp"
#include "http/IApi.hpp"
#include <acs/core/Now.hpp>

#include <string>
#include <vector>

namespace ACS::Acsctl
{

/// What a bundle shall contain: a file and the GET that it is read with.
struct BundlePart
{
    std::string fileName;
    std::string target;
};

/// A finished bundle.
struct SupportBundle
{
    std::string archive;              ///< .tar.gz
    std::string manifest;             ///< JSON: also a file of the archive.
    std::vector<std::string> missing; ///< Files that are not in it, with the reason.
};

/// The parts of the operator API.
[[nodiscard]] std::vector<BundlePart> ListBundleParts();
/// The parts at http.listen.
[[nodiscard]] std::vector<BundlePart> ListHttpParts();

/// Collects the parts. A part that cannot be read is listed in the manifest; an error only if the status cannot be read. The
/// second API is that of http.listen, nullptr: none. No header of a request is in the bundle, hence no token.
[[nodiscard]] Outcome<SupportBundle> CollectBundle(
    IApi& api,
    IApi* httpOrNull,
    const std::string& url,
    Core::WallTime now);

} // namespace ACS::Acsctl
