#pragma once

#include "MosquittoBroker.hpp"
#include "RecordingListener.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/io_context.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace ACS::Testing
{

/// Runs the loop until the condition holds; false at the time limit.
inline bool TryRunUntil(
    boost::asio::io_context& context,
    const std::function<bool()>& isTrue,
    std::chrono::milliseconds timeout = std::chrono::seconds(15))
{
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    context.restart();
    while (!isTrue())
    {
        if (context.run_one_until(deadline) == 0)
        {
            return isTrue();
        }
    }
    return true;
}

/// A link to the test's broker, with short delays between attempts.
struct TestLink
{
    RecordingLogSink log;
    SeededRandom random;
    RecordingListener listener;
    VDA5050::MosquittoLink link;

    TestLink(boost::asio::io_context& context, VDA5050::MosquittoOptions options)
        : link(context.get_executor(), random, Core::Logger(log, "mqtt"), std::move(options), listener)
    {
    }
};

inline VDA5050::MosquittoOptions MakeOptions(std::uint16_t port, std::string clientID)
{
    VDA5050::MosquittoOptions options;
    options.port = port;
    options.clientID = std::move(clientID);
    options.backoff.initial = std::chrono::milliseconds(20);
    options.backoff.maximum = std::chrono::milliseconds(200);
    return options;
}

} // namespace ACS::Testing
