#pragma once

#include "config/AcsdConfig.hpp"
#include "trace/MessageTrace.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>

namespace ACS::Acsd
{

/// acsd as a whole: the engine, its store, the link to the MCS, the broker and the robots. Carries out the engine's
/// actions strictly in their order; a store action is confirmed before what stands behind it is carried out. One thread:
/// the executor's.
class Acsd final
{
    class Impl;
    std::unique_ptr<Impl> _impl;

    explicit Acsd(std::unique_ptr<Impl> impl);

public:
    using StopHandler = std::function<void()>;

    /// What the program gives; everything outlives acsd.
    struct Surroundings
    {
        boost::asio::any_io_executor executor;
        Core::IClock& clock;
        Core::IRandom& random;
        Core::Logger logger;
        MessageTrace* traceOrNull = nullptr;
    };

    /// Opens the store, takes up what it holds and listens on its HTTP address; connects to nothing yet. The
    /// configuration must be without mistakes. Errors, each a sentence with what to do: the store, the HTTP address.
    [[nodiscard]] static Core::Result<std::unique_ptr<Acsd>> Create(Surroundings surroundings, AcsdConfig config);

    Acsd(const Acsd&) = delete;
    Acsd& operator=(const Acsd&) = delete;
    ~Acsd();

    /// Connects to the MCS, the broker and the arms, and goes on doing so for ever.
    void Start();

    /// Takes from a second reading, without mistakes, what may change while acsd runs, and logs for each key that differs
    /// whether it was taken or needs a restart.
    void Reload(const AcsdConfig& fresh);

    /// Refuses plans and controls from now on, waits until the MCS has all reports (at most `shutdown.drain_timeout`), takes
    /// leave of everybody within a bounded time, then calls back, once. Robots go on with what they have.
    void StopAsync(StopHandler handler);

    /// Where the HTTP side serves, with its real port.
    [[nodiscard]] Apps::Endpoint GetHttpEndpoint() const;
};

} // namespace ACS::Acsd
