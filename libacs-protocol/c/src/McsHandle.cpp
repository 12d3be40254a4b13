#include "SessionHandle.hpp"
#include <acs/c/acs_protocol.h>
#include <acs/protocol/McsSession.hpp>
#include <acs/protocol/SessionOptions.hpp>

#include <algorithm>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>

// NOLINTBEGIN(readability-identifier-naming): the names of a C interface

struct acs_mcs : ACS::CInterface::SessionHandle
{
    ACS::Protocol::McsSession session;
    ACS::Protocol::ConnectionID lastConnection = 0;

    acs_mcs(const ACS::Protocol::McsSessionOptions& options, acs_random randomOrNull, void* contextOrNull)
        : SessionHandle(options.codec, randomOrNull, contextOrNull),
          session(options, _random)
    {
    }
};

namespace ACS::CInterface
{

namespace
{

void WriteDefaults(acs_mcs_options& options)
{
    const Protocol::McsSessionOptions defaults;
    options = {};
    options.struct_size = sizeof(options);
    options.ack_timeout_ms = defaults.ackTimeout.count();
    options.answer_timeout_ms = defaults.answerTimeout.count();
    options.registration_timeout_ms = defaults.registrationTimeout.count();
    options.answer_bytes = defaults.answerBytes;
    options.ack_retries = static_cast<std::uint32_t>(defaults.ackRetries);
    options.max_pending = static_cast<std::uint32_t>(defaults.maximumPending);
    options.duplicate_memory = static_cast<std::uint32_t>(defaults.duplicateMemory);
    options.max_unanswered = static_cast<std::uint32_t>(defaults.maximumUnanswered);
    options.silent_if_unanswered = defaults.unansweredPolicy == Protocol::EUnansweredPolicy::Silence ? 1 : 0;
    options.withhold_plans = defaults.bPlansWithheld ? 1 : 0;
    options.refuse_second = defaults.bSecondRefused ? 1 : 0;
    WriteCodecDefaults(options.codec);
}

std::optional<Protocol::EAcsCommand> FindCommandOrNull(std::string_view name)
{
    for (std::size_t index = 0; index < Protocol::COMMAND_COUNT; ++index)
    {
        const auto command = static_cast<Protocol::EAcsCommand>(index);
        if (Protocol::GetText(command) == name)
        {
            return command;
        }
    }
    return std::nullopt;
}

/// Names of commands, separated by a space each.
std::bitset<Protocol::COMMAND_COUNT> ReadCommands(const acs_text& names, Arguments& arguments)
{
    std::bitset<Protocol::COMMAND_COUNT> commands;
    std::string_view rest = names.data == nullptr ? std::string_view() : arguments.ReadText(names.data, names.length);
    while (!rest.empty())
    {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        const std::optional<Protocol::EAcsCommand> commandOrNull = FindCommandOrNull(rest.substr(0, end));
        const bool bAnswered =
            commandOrNull.has_value() && !Protocol::IsSentByMCS(*commandOrNull) && Protocol::HasAck(*commandOrNull);
        if (!bAnswered)
        {
            arguments.Add(ACS_ERROR_ARGUMENT);
            return commands;
        }
        commands.set(static_cast<std::size_t>(*commandOrNull));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return commands;
}

Protocol::McsSessionOptions ReadOptions(const acs_mcs_options& options, Arguments& arguments)
{
    Protocol::McsSessionOptions result;
    arguments.Add(CheckStruct(&options));
    if (!arguments.IsValid())
    {
        return result;
    }
    result.ackTimeout = arguments.ReadDuration(options.ack_timeout_ms, 1);
    result.answerTimeout = arguments.ReadDuration(options.answer_timeout_ms, 1);
    result.registrationTimeout = arguments.ReadDuration(options.registration_timeout_ms, 1);
    result.answerBytes = arguments.ReadCount(options.answer_bytes, 0, ACS_SIZE_MAX);
    result.ackRetries = arguments.ReadCount(options.ack_retries, 0, ACS_COUNT_MAX);
    result.maximumPending = arguments.ReadCount(options.max_pending, 1, ACS_COUNT_MAX);
    result.duplicateMemory = arguments.ReadCount(options.duplicate_memory, 1, ACS_COUNT_MAX);
    result.maximumUnanswered = arguments.ReadCount(options.max_unanswered, 1, ACS_COUNT_MAX);
    result.unansweredPolicy =
        options.silent_if_unanswered != 0 ? Protocol::EUnansweredPolicy::Silence : Protocol::EUnansweredPolicy::Fail;
    result.bPlansWithheld = options.withhold_plans != 0;
    result.bSecondRefused = options.refuse_second != 0;
    result.answeredByApplication = ReadCommands(options.answered_commands, arguments);
    result.codec = arguments.ReadCodecOptions(options.codec);
    arguments.Add(options.reserved == 0 ? ACS_OK : ACS_ERROR_ARGUMENT);
    return result;
}

std::int32_t Send(
    acs_mcs& mcs,
    std::string_view text,
    acs_message* messageOrNull,
    Core::Now now,
    Protocol::SessionActions& out)
{
    const Protocol::DecodeOutcome outcome = mcs.Decode(text, now);
    if (const std::int32_t result = mcs.Show(outcome, messageOrNull); result != ACS_OK)
    {
        return result;
    }
    const auto* const requestOrNull = std::get_if<Protocol::AcsRequest>(&*outcome.message);
    if (requestOrNull == nullptr || !Protocol::IsSentByMCS(Protocol::GetCommand(*requestOrNull)))
    {
        return ACS_ERROR_DIRECTION;
    }
    return mcs.session.TrySend(*requestOrNull, now, out) ? ACS_OK : ACS_ERROR_NOT_READY;
}

} // namespace

} // namespace ACS::CInterface

using ACS::CInterface::Arguments;
using ACS::CInterface::CheckStruct;
using ACS::Core::Now;
using ACS::Protocol::SessionActions;

extern "C"
{
    std::int32_t acs_mcs_options_init(acs_mcs_options* options, std::size_t options_size)
    {
        if (options == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        if (options_size != sizeof(*options))
        {
            return ACS_ERROR_VERSION;
        }
        ACS::CInterface::WriteDefaults(*options);
        return ACS_OK;
    }

    std::int32_t acs_mcs_create(std::uint32_t abi_version, const acs_mcs_options* options, acs_mcs** mcs)
    {
        if (mcs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        *mcs = nullptr;
        if (abi_version != ACS_C_ABI_VERSION)
        {
            return ACS_ERROR_VERSION;
        }
        return ACS::CInterface::Guard([&]() -> std::int32_t {
            Arguments arguments;
            acs_mcs_options defaults;
            ACS::CInterface::WriteDefaults(defaults);
            const acs_mcs_options& used = options == nullptr ? defaults : *options;
            const ACS::Protocol::McsSessionOptions sessionOptions = ACS::CInterface::ReadOptions(used, arguments);
            if (arguments.IsValid())
            {
                *mcs = std::make_unique<acs_mcs>(sessionOptions, used.random, used.random_context).release();
            }
            return arguments.GetResult();
        });
    }

    void acs_mcs_destroy(acs_mcs* mcs)
    {
        const std::unique_ptr<acs_mcs> ended(mcs);
    }

    std::int32_t acs_mcs_connected(acs_mcs* mcs, std::uint64_t connection, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        if (mcs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        return mcs->Run({}, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            if (connection <= mcs->lastConnection)
            {
                return ACS_ERROR_ARGUMENT;
            }
            mcs->lastConnection = connection;
            mcs->session.OnConnected(connection, now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_mcs_received(
        acs_mcs* mcs,
        std::uint64_t connection,
        const char* text,
        std::size_t length,
        std::int64_t steady_ms,
        std::int64_t wall_ms)
    {
        if (mcs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        Arguments arguments;
        const std::string_view bytes = arguments.ReadBytes(text, length);
        return mcs->Run(arguments, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            mcs->session.OnText(connection, bytes, now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_mcs_closed(
        acs_mcs* mcs,
        std::uint64_t connection,
        const char* reason,
        std::size_t reason_length,
        std::int64_t steady_ms,
        std::int64_t wall_ms)
    {
        if (mcs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        Arguments arguments;
        const std::string_view reasonText = arguments.ReadText(reason, reason_length);
        return mcs->Run(arguments, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            mcs->session.OnClosed(connection, reasonText, now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_mcs_timer_elapsed(acs_mcs* mcs, std::int32_t timer, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        if (mcs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        Arguments arguments;
        const ACS::Protocol::ESessionTimer name = arguments.ReadTimer(timer);
        return mcs->Run(arguments, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            mcs->session.OnTimer(name, now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_mcs_send(
        acs_mcs* mcs,
        const char* text,
        std::size_t length,
        std::int64_t steady_ms,
        std::int64_t wall_ms,
        acs_message* message)
    {
        if (mcs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        Arguments arguments;
        const std::string_view bytes = arguments.ReadBytes(text, length);
        arguments.Add(message == nullptr ? ACS_OK : CheckStruct(message));
        return mcs->Run(arguments, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            return ACS::CInterface::Send(*mcs, bytes, message, now, out);
        });
    }

    std::int32_t acs_mcs_answer(
        acs_mcs* mcs,
        std::uint64_t token,
        std::int32_t result,
        const char* text,
        std::size_t text_length,
        std::int64_t steady_ms,
        std::int64_t wall_ms)
    {
        if (mcs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        Arguments arguments;
        const ACS::Protocol::EAckResult ackResult = arguments.ReadAckResult(result);
        const std::string_view note = arguments.ReadText(text, text_length);
        return mcs->Run(arguments, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            return mcs->session.TryAnswer(token, ackResult, note, now, out) ? ACS_OK : ACS_ERROR_NOT_WAITING;
        });
    }

    std::int32_t acs_mcs_next_action(acs_mcs* mcs, acs_action* action)
    {
        if (const std::int32_t result = CheckStruct(action); result != ACS_OK || mcs == nullptr)
        {
            return result == ACS_OK ? ACS_ERROR_ARGUMENT : result;
        }
        return mcs->Use([&]() -> std::int32_t {
            mcs->TakeAction(*action);
            return ACS_OK;
        });
    }

    std::int32_t acs_mcs_get_state(acs_mcs* mcs, acs_mcs_state* state)
    {
        if (const std::int32_t result = CheckStruct(state); result != ACS_OK || mcs == nullptr)
        {
            return result == ACS_OK ? ACS_ERROR_ARGUMENT : result;
        }
        return mcs->Use([&]() -> std::int32_t {
            const ACS::Protocol::McsSession& session = mcs->session;
            state->registered = session.IsRegistered() ? 1 : 0;
            state->takes_plans = session.IsTakingPlans() ? 1 : 0;
            state->refuses_upgrade = session.ShouldRefuseUpgrade() ? 1 : 0;
            state->connection = session.GetRegisteredOrNull().value_or(0);
            state->pending = session.GetPendingCount();
            state->unanswered = session.GetUnansweredCount();
            state->waiting_actions = mcs->GetWaitingCount();
            return ACS_OK;
        });
    }

    std::int32_t acs_mcs_set_site_offset(acs_mcs* mcs, std::int32_t minutes)
    {
        if (mcs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        return mcs->Use([&]() -> std::int32_t {
            Arguments arguments;
            const std::chrono::minutes offset = arguments.ReadOffset(minutes);
            if (arguments.IsValid())
            {
                mcs->session.SetSiteOffset(offset);
                mcs->SetSiteOffset(offset);
            }
            return arguments.GetResult();
        });
    }

} // extern "C"

// NOLINTEND(readability-identifier-naming)
