#pragma once

#include "common/config/Endpoint.hpp"

#include <string>
#include <vector>

namespace ACS::Apps
{

/// An address on which a program listens.
struct ReadyAddress
{
    std::string name;  ///< "http", "ws", "stream", "broker"; each once.
    Endpoint endpoint; ///< With the real port, never 0.
};

/// "ready: http=127.0.0.1:8080 ws=…", without line end.
[[nodiscard]] std::string MakeReadyLine(const std::vector<ReadyAddress>& addresses);

/// Prints that line on standard output and flushes it for a reader of a pipe.
void PrintReadyLine(const std::vector<ReadyAddress>& addresses);

} // namespace ACS::Apps
