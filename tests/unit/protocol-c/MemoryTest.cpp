// Fails every allocation of the C interface once: each call returns ACS_ERROR_MEMORY or succeeds, no exception leaves it, a codec can be
// used afterwards, and a session refuses all later calls.

#include <acs/c/acs_protocol.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string_view>

namespace
{

constexpr std::uint64_t NEVER = UINT64_MAX;
constexpr std::size_t LONG_TEXT = 99'999;
constexpr std::string_view REGISTRATION = R"({"command":"Registration","transactionId":"t-1","payload":{}})";
constexpr std::string_view CANCEL = R"({"command":"CancelPlan","transactionId":"t-2","payload":{"planId":"P-1"}})";

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): operator new has no other state
std::uint64_t allocationsLeft = NEVER;

[[nodiscard]] void* AllocateOrNull(std::size_t size)
{
    if (allocationsLeft == 0)
    {
        return nullptr;
    }
    allocationsLeft -= allocationsLeft == NEVER ? 0U : 1U;
    return std::malloc(size == 0 ? 1 : size); // NOLINT(cppcoreguidelines-no-malloc): replaces operator new
}

/// Longer than the buffers that the parser begins with; without a message.
std::int32_t DecodeLongText(acs_codec* codec, acs_message& message)
{
    static const std::array<char, LONG_TEXT> TEXT = [] {
        std::array<char, LONG_TEXT> text{};
        text.fill(' ');
        for (std::size_t i = 0; i < LONG_TEXT - 1; i += 2)
        {
            text[i] = i == 0 ? '[' : ',';
            text[i + 1] = '1';
        }
        text.back() = ']';
        return text;
    }();
    const std::int32_t result = acs_codec_decode(codec, TEXT.data(), TEXT.size(), &message);
    return result == ACS_ERROR_MESSAGE ? ACS_OK : result;
}

/// The first call that fails: ACS_OK if none does.
std::int32_t RunCodec()
{
    acs_codec* codec = nullptr;
    std::int32_t result = acs_codec_create(ACS_C_ABI_VERSION, nullptr, &codec);
    acs_message message{};
    message.struct_size = sizeof(message);
    if (result == ACS_OK)
    {
        result = acs_codec_decode(codec, CANCEL.data(), CANCEL.size(), &message);
    }
    if (result == ACS_OK)
    {
        result = acs_codec_decode(codec, CANCEL.data(), CANCEL.size() / 2, &message);
        result = result == ACS_ERROR_MESSAGE ? ACS_OK : result;
    }
    if (result == ACS_OK)
    {
        result = DecodeLongText(codec, message);
    }
    if (result == ACS_OK)
    {
        constexpr std::string_view COMMAND = "CancelPlan";
        constexpr std::string_view PAYLOAD = R"({"planId":"a plan"})";
        result =
            acs_codec_make_request(codec, COMMAND.data(), COMMAND.size(), PAYLOAD.data(), PAYLOAD.size(), 0, &message);
    }
    if (result != ACS_OK && codec != nullptr)
    {
        allocationsLeft = NEVER; // a codec can be used after a failure
        const std::int32_t later = acs_codec_decode(codec, CANCEL.data(), CANCEL.size(), &message);
        result = later == ACS_OK ? result : ACS_ERROR_INTERNAL;
    }
    acs_codec_destroy(codec);
    return result;
}

std::int32_t TakeActions(acs_mcs* mcs)
{
    acs_action action{};
    action.struct_size = sizeof(action);
    std::int32_t result = acs_mcs_next_action(mcs, &action);
    while (result == ACS_OK && action.type != ACS_ACTION_NONE)
    {
        result = acs_mcs_next_action(mcs, &action);
    }
    return result;
}

std::int32_t RunSession(bool& bRefusedAfterwards)
{
    acs_mcs* mcs = nullptr;
    std::int32_t result = acs_mcs_create(ACS_C_ABI_VERSION, nullptr, &mcs);
    if (result != ACS_OK)
    {
        return result;
    }
    result = acs_mcs_connected(mcs, 1, 0, 0);
    if (result == ACS_OK)
    {
        result = acs_mcs_received(mcs, 1, REGISTRATION.data(), REGISTRATION.size(), 0, 0);
    }
    if (result == ACS_OK)
    {
        result = acs_mcs_send(mcs, CANCEL.data(), CANCEL.size(), 0, 0, nullptr);
    }
    if (result == ACS_OK)
    {
        result = acs_mcs_closed(mcs, 1, "the cable was pulled out of the switch", 10, 0, 0);
    }
    if (result == ACS_OK)
    {
        result = TakeActions(mcs);
    }
    if (result != ACS_OK)
    {
        allocationsLeft = NEVER;
        bRefusedAfterwards =
            acs_mcs_connected(mcs, 2, 0, 0) == ACS_ERROR_BROKEN && TakeActions(mcs) == ACS_ERROR_BROKEN;
    }
    acs_mcs_destroy(mcs);
    return result;
}

/// Fails the first allocation, then the second one, and so on, until a run needs no more.
template <typename TRun>
bool IsSafe(const char* name, TRun run)
{
    for (std::uint64_t count = 0;; ++count)
    {
        allocationsLeft = count;
        const std::int32_t result = run();
        allocationsLeft = NEVER;
        if (result == ACS_OK)
        {
            std::printf("%s: %u allocations\n", name, static_cast<unsigned>(count));
            return count > 0;
        }
        if (result != ACS_ERROR_MEMORY)
        {
            std::printf("%s: result %d after %u allocations\n", name, result, static_cast<unsigned>(count));
            return false;
        }
    }
}

} // namespace

// NOLINTBEGIN(cppcoreguidelines-no-malloc,misc-new-delete-overloads): the library calls these
void* operator new(std::size_t size)
{
    void* const block = AllocateOrNull(size);
    if (block == nullptr)
    {
        throw std::bad_alloc();
    }
    return block;
}

void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
    return AllocateOrNull(size);
}

void operator delete(void* blockOrNull) noexcept
{
    std::free(blockOrNull);
}

void operator delete(void* blockOrNull, std::size_t /*size*/) noexcept
{
    std::free(blockOrNull);
}
// NOLINTEND(cppcoreguidelines-no-malloc,misc-new-delete-overloads)

int main()
{
    bool bRefusedAfterwards = true;
    const bool bCodec = IsSafe("codec", RunCodec);
    const bool bSession = IsSafe("session", [&bRefusedAfterwards] {
        bool bRefused = true;
        const std::int32_t result = RunSession(bRefused);
        bRefusedAfterwards = bRefusedAfterwards && bRefused;
        return result;
    });
    std::printf("refused afterwards: %s\n", bRefusedAfterwards ? "yes" : "no");
    return bCodec && bSession && bRefusedAfterwards ? 0 : 1;
}
