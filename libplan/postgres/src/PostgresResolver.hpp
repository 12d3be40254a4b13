#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <functional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// The addresses of a host; empty for a local socket and for an address, which libpq can use as they are. libpq would wait for a
/// name server without a limit; this waits until the deadline, or until the function returns true (it may be empty). The name is
/// that of the store.
[[nodiscard]] Core::Result<std::vector<std::string>> ResolveHost(
    const std::string& host,
    Core::SteadyTime deadline,
    const std::function<bool()>& shouldStop,
    const std::string& name);

} // namespace ACS::Planning
