#include "common/process/ReadyLine.hpp"

#include <fmt/format.h>

#include <iostream>

namespace ACS::Apps
{

std::string MakeReadyLine(const std::vector<ReadyAddress>& addresses)
{
    std::string line = "ready:";
    for (const ReadyAddress& address : addresses)
    {
        line += fmt::format(" {}={}", address.name, MakeText(address.endpoint));
    }
    return line;
}

void PrintReadyLine(const std::vector<ReadyAddress>& addresses)
{
    std::cout << MakeReadyLine(addresses) << std::endl;
}

} // namespace ACS::Apps
