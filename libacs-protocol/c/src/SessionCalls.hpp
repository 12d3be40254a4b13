#pragma once

#include "Arguments.hpp"
#include "Guard.hpp"
#include "SessionHandle.hpp"
#include <acs/c/acs_protocol.h>
#include <acs/core/Now.hpp>
#include <acs/protocol/SessionAction.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <type_traits>
#include <variant>

/// What the functions of both sessions share. A handle derives from SessionHandle, has its session, the type Options, and the
/// static functions WriteDefaults and ReadOptions.
namespace ACS::CInterface
{

template <typename THandle>
[[nodiscard]] std::int32_t CreateHandle(
    std::uint32_t abiVersion,
    const typename THandle::Options* optionsOrNull,
    THandle** handleOrNull) noexcept
{
    if (handleOrNull == nullptr)
    {
        return ACS_ERROR_ARGUMENT;
    }
    *handleOrNull = nullptr;
    if (abiVersion != ACS_C_ABI_VERSION)
    {
        return ACS_ERROR_VERSION;
    }
    return Guard([&]() -> std::int32_t {
        Arguments arguments;
        typename THandle::Options defaults;
        THandle::WriteDefaults(defaults);
        const typename THandle::Options& used = optionsOrNull == nullptr ? defaults : *optionsOrNull;
        const auto options = THandle::ReadOptions(used, arguments);
        if (arguments.IsValid())
        {
            *handleOrNull = std::make_unique<THandle>(options, used.random, used.random_context).release();
        }
        return arguments.GetResult();
    });
}

/// Calls call(session, values..., now, out), which returns nothing or a result. Nothing is called if an argument is invalid.
template <typename THandle, typename TCall, typename... TValues>
[[nodiscard]] std::int32_t CallSession(
    THandle* handleOrNull,
    const Arguments& arguments,
    CallTime time,
    TCall call,
    const TValues&... values) noexcept
{
    if (handleOrNull == nullptr)
    {
        return ACS_ERROR_ARGUMENT;
    }
    return handleOrNull->Run(arguments, time, [&](Core::Now now, Protocol::SessionActions& out) -> std::int32_t {
        if constexpr (std::is_void_v<decltype(std::invoke(call, handleOrNull->session, values..., now, out))>)
        {
            std::invoke(call, handleOrNull->session, values..., now, out);
            return ACS_OK;
        }
        else
        {
            return std::invoke(call, handleOrNull->session, values..., now, out);
        }
    });
}

/// Decodes a TMessage (AcsRequest or AcsAck), shows it to the caller, and passes it to send(session, message, now, out).
template <typename TMessage, typename THandle, typename TSend>
[[nodiscard]] std::int32_t SendMessage(
    THandle* handleOrNull,
    const char* textOrNull,
    std::size_t length,
    CallTime time,
    acs_message* shownOrNull,
    TSend send) noexcept
{
    Arguments arguments;
    const std::string_view text = arguments.ReadBytes(textOrNull, length);
    arguments.Add(shownOrNull == nullptr ? ACS_OK : CheckStruct(shownOrNull));
    return CallSession(
        handleOrNull,
        arguments,
        time,
        [&](auto& session, Core::Now now, Protocol::SessionActions& out) -> std::int32_t {
            const Protocol::DecodeOutcome outcome = handleOrNull->Decode(text, now);
            if (const std::int32_t result = handleOrNull->Show(outcome, shownOrNull); result != ACS_OK)
            {
                return result;
            }
            const auto* const messageOrNull = std::get_if<TMessage>(&*outcome.message);
            return messageOrNull == nullptr ? ACS_ERROR_DIRECTION : send(session, *messageOrNull, now, out);
        });
}

/// Fills a structure of the caller.
template <typename THandle, typename TStruct, typename TCall>
[[nodiscard]] std::int32_t FillStruct(THandle* handleOrNull, TStruct* structOrNull, TCall call) noexcept
{
    if (const std::int32_t result = CheckStruct(structOrNull); result != ACS_OK || handleOrNull == nullptr)
    {
        return result == ACS_OK ? ACS_ERROR_ARGUMENT : result;
    }
    return handleOrNull->Use([&]() -> std::int32_t {
        call(*structOrNull);
        return ACS_OK;
    });
}

template <typename THandle>
[[nodiscard]] std::int32_t SetSiteOffset(THandle* handleOrNull, std::int32_t minutes) noexcept
{
    if (handleOrNull == nullptr)
    {
        return ACS_ERROR_ARGUMENT;
    }
    return handleOrNull->Use([&]() -> std::int32_t {
        Arguments arguments;
        const std::chrono::minutes offset = arguments.ReadOffset(minutes);
        if (arguments.IsValid())
        {
            handleOrNull->session.SetSiteOffset(offset);
            handleOrNull->SetSiteOffset(offset);
        }
        return arguments.GetResult();
    });
}

} // namespace ACS::CInterface
