#pragma once

#include <acs/core/Now.hpp>
#include <acs/net/TimerArray.hpp>
#include <acs/openstream/IOpenApiService.hpp>
#include <acs/openstream/ServerSessionActions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace ACS::OpenStreamAsio
{

/// Calls the service for a connection, and keeps each answer while the service delays it.
class ServiceCaller
{
public:
    /// What an answer is to. Of each kind one is waited for at a time.
    enum class EAnswer : std::uint8_t
    {
        Sample,
        Control,
    };

    struct Answer
    {
        EAnswer kind = EAnswer::Sample;
        OpenStream::ApiResponse response; ///< The next one uses its room.
        std::uint64_t token = 0;
    };

    using AnswerHandler = std::function<void(const Answer& answer)>;

private:
    static constexpr std::size_t ANSWERS = 2;

    using Timers = Net::TimerArray<EAnswer, ANSWERS>;

    OpenStream::IOpenApiService& _service;
    std::array<Answer, ANSWERS> _answers; ///< By EAnswer.
    std::shared_ptr<Timers> _timers;

public:
    /// The handler gets the delayed answers.
    ServiceCaller(
        const boost::asio::any_io_executor& executor,
        OpenStream::IOpenApiService& service,
        AnswerHandler onDelayed);

    /// Valid until the next call of its kind.
    [[nodiscard]] const Answer& Call(const OpenStream::ServerCall& call, Core::Now now);

    /// False if the service does not delay the answer. A delayed one of the same kind belongs to a MONITOR that was
    /// replaced, and is discarded.
    [[nodiscard]] bool TryDelay(const Answer& answer);

    void StopControl(Core::Now now);

    /// Discards the delayed answers.
    void Cancel();
};

} // namespace ACS::OpenStreamAsio
