#include "plans/PlanFile.hpp"

#include "common/config/TextFile.hpp"
#include <acs/protocol/AcsCodec.hpp>

#include <utility>
#include <variant>

namespace ACS::McsSim
{

namespace
{

constexpr std::string_view BYTE_ORDER_MARK = "\xEF\xBB\xBF";

Core::Result<PlannedPlan> TakePlan(Protocol::AcsMessage&& message)
{
    Protocol::AcsRequest* const requestOrNull = std::get_if<Protocol::AcsRequest>(&message);
    Protocol::ExecutionPlan* const planOrNull =
        requestOrNull == nullptr ? nullptr : std::get_if<Protocol::ExecutionPlan>(&requestOrNull->payload);
    if (planOrNull == nullptr)
    {
        return Core::Fail(Core::ECoreError::UnknownWord, "command", "ExecutionPlan", "another command");
    }
    return PlannedPlan{std::move(*planOrNull), std::move(requestOrNull->transactionID)};
}

} // namespace

Core::Result<PlannedPlan> ParsePlanFile(std::string_view text)
{
    if (text.starts_with(BYTE_ORDER_MARK))
    {
        text.remove_prefix(BYTE_ORDER_MARK.size());
    }
    Protocol::AcsCodec codec;
    Protocol::DecodeOutcome whole = codec.Decode(text);
    if (whole.message.has_value())
    {
        return TakePlan(std::move(*whole.message));
    }
    const Protocol::DecodeFailure& failure = whole.message.error();
    // Only what is JSON without a command can be a payload; of everything else the first error is the right one.
    if (!failure.commandName.empty() || failure.error.code == Core::ECoreError::InvalidJSON
        || failure.error.code == Core::ECoreError::TooLarge)
    {
        return tl::make_unexpected(failure.error);
    }
    std::string message =
        R"({"command":"ExecutionPlan","transactionId":"-","timestamp":"1970-01-01T00:00:00Z","payload":)";
    message += text;
    message += '}';
    Protocol::DecodeOutcome wrapped = codec.Decode(message);
    if (!wrapped.message.has_value())
    {
        return tl::make_unexpected(wrapped.message.error().error);
    }
    Core::Result<PlannedPlan> planned = TakePlan(std::move(*wrapped.message));
    if (planned.has_value())
    {
        planned->transactionID.clear();
    }
    return planned;
}

tl::expected<PlannedPlan, std::string> ReadPlanFile(const std::string& path)
{
    const tl::expected<std::string, std::string> content = Apps::ReadTextFile(path);
    if (!content.has_value() || content->empty())
    {
        const std::string reason = content.has_value() ? "it is empty" : content.error();
        return tl::make_unexpected("the plan file " + path + " cannot be read: " + reason);
    }
    Core::Result<PlannedPlan> planned = ParsePlanFile(*content);
    if (!planned.has_value())
    {
        return tl::make_unexpected("the plan file " + path + " holds no ExecutionPlan: " + Describe(planned.error()));
    }
    return std::move(*planned);
}

} // namespace ACS::McsSim
