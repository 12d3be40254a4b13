#pragma once

#include "common/Endpoint.hpp"

#include <initializer_list>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// One address of a program that can serve.
struct ReadyAddress
{
    std::string_view name; ///< "http", "ws", "stream", "broker"
    Endpoint endpoint;     ///< With the real port, never 0.
};

/// "ready: http=127.0.0.1:8080 ws=…", without line end.
[[nodiscard]] std::string MakeReadyLine(std::initializer_list<ReadyAddress> addresses);

/// Prints that line on standard output and flushes, so that whoever waits for it in a pipe sees it at once.
void PrintReadyLine(std::initializer_list<ReadyAddress> addresses);

} // namespace ACS::Apps
