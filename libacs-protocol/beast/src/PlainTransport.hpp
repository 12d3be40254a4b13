#pragma once

#include "ITransport.hpp"

#include <memory>

namespace ACS::ProtocolBeast
{

/// ws
[[nodiscard]] std::unique_ptr<ITransport> MakePlainTransport();

} // namespace ACS::ProtocolBeast
