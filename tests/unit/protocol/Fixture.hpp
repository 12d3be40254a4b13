#pragma once

#include <acs/protocol/AcsMessage.hpp>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace ACS::Testing
{

/// The text of a file of tests/fixtures/acs.
inline std::string ReadFixture(const std::string& name)
{
    std::ifstream file(std::string(ACS_FIXTURES) + "/" + name + ".json", std::ios::binary);
    if (!file)
    {
        throw std::runtime_error("no fixture " + name);
    }
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A request as a peer would write it.
inline std::string MakeRequestText(
    const std::string& command,
    const std::string& payload,
    const std::string& transactionID = "t-1")
{
    return R"({"command":")" + command + R"(","transactionId":")" + transactionID
        + R"(","timestamp":"2025-07-02T21:00:00.123+09:00","payload":)" + payload + "}";
}

inline std::string MakeAckText(
    const std::string& command,
    const std::string& transactionID,
    const std::string& result = "Success",
    const std::string& payload = "{}")
{
    return R"({"command":")" + command + R"(Ack","transactionId":")" + transactionID
        + R"(","timestamp":"2025-07-02T21:00:00.123+09:00","result":")" + result + R"(","message":"","payload":)"
        + payload + "}";
}

} // namespace ACS::Testing
