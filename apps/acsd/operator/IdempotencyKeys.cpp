#include "operator/IdempotencyKeys.hpp"

#include "operator/OperatorAnswer.hpp"
#include "operator/OperatorToken.hpp"
#include <acs/core/Result.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr unsigned KEY_INVALID = 400;
constexpr unsigned KEY_REUSED = 409;
constexpr unsigned FIRST_NOT_KEPT = 500;
constexpr std::size_t LONGEST_KEY = 64;

bool IsKey(std::string_view text)
{
    const auto isLetter = [](char letter) {
        return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9')
            || letter == '.' || letter == '_' || letter == '-';
    };
    return !text.empty() && text.size() <= LONGEST_KEY && std::ranges::all_of(text, isLetter);
}

/// The parts of a request have no zero byte but the body, which is the last.
std::string MakeDigest(const Apps::HttpRequest& request)
{
    const std::string text = request.method + '\0' + request.target + '\0' + request.body;
    return fmt::format("{:02x}", fmt::join(HashToken(text), ""));
}

std::string MakeOwner(std::string_view proof, std::string_view name)
{
    return fmt::format("{} {}", proof, name);
}

std::string GetString(const Json::Value& object, std::string_view name)
{
    const Json::Value* const valueOrNull = Json::FindFirstOrNull(object, name);
    return valueOrNull != nullptr && valueOrNull->IsString()
        ? std::string(valueOrNull->GetString(), valueOrNull->GetStringLength())
        : std::string();
}

std::string EncodeAnswer(std::string_view digest, const Apps::HttpResponse& response)
{
    std::string text;
    Json::JsonWriter writer(text);
    writer.BeginObject();
    writer.Key("digest");
    writer.WriteString(digest);
    writer.Key("status");
    writer.WriteUnsigned(response.status);
    writer.Key("body");
    writer.WriteString(response.body);
    writer.EndObject();
    return text;
}

} // namespace

IdempotencyKeys::Answer IdempotencyKeys::Respond(
    const Apps::HttpRequest& request,
    const OperatorIdentity& identity,
    Core::SteadyTime now,
    const std::function<Apps::HttpResponse()>& respond)
{
    const std::optional<std::string> key = request.GetHeaderOrNull("Idempotency-Key");
    if (!key.has_value())
    {
        return {respond()};
    }
    if (!IsKey(*key))
    {
        return {MakeOperatorError(
            KEY_INVALID,
            fmt::format(
                "Expected an Idempotency-Key of 1 to {} letters, digits and . _ -, found {}.",
                LONGEST_KEY,
                Core::QuoteForError(*key)))};
    }
    std::erase_if(_answers, [now](const Kept& answer) {
        return now - answer.answeredAt >= Planning::CommandReceipt::KEPT;
    });
    const std::string owner = MakeOwner(GetText(identity.proof), identity.name);
    const CommandKey used{*key, MakeDigest(request), true};
    if (const Kept* const keptOrNull = FindOrNull(owner, *key); keptOrNull != nullptr)
    {
        if (keptOrNull->used.digest != used.digest)
        {
            return {MakeOperatorError(KEY_REUSED, "This Idempotency-Key was used for another request: use a new one.")};
        }
        Answer answer{keptOrNull->response, used};
        answer.response.headers.emplace_back("Idempotent-Replay", "true");
        return answer;
    }
    _current = {owner, *key, used.digest};
    Apps::HttpResponse response = respond();
    std::optional<UsedKey> current = std::exchange(_current, std::nullopt);
    if (response.status >= FIRST_NOT_KEPT || !current.has_value())
    {
        return {std::move(response)};
    }
    Add({std::move(*current), response, now});
    return {std::move(response), {*key, used.digest, false}};
}

std::optional<Planning::CommandReceipt> IdempotencyKeys::MakeReceiptOrNull(
    const Apps::HttpResponse& answer,
    Core::WallTime now) const
{
    if (!_current.has_value())
    {
        return std::nullopt;
    }
    return Planning::CommandReceipt{_current->owner, _current->key, EncodeAnswer(_current->digest, answer), now};
}

void IdempotencyKeys::Forget(const Planning::CommandReceipt& receipt)
{
    const auto isMeant = [&receipt](const UsedKey& used) {
        return used.owner == receipt.owner && used.key == receipt.key;
    };
    std::erase_if(_answers, [&isMeant](const Kept& kept) { return isMeant(kept.used); });
    if (_current.has_value() && isMeant(*_current))
    {
        _current.reset();
    }
}

void IdempotencyKeys::Restore(const std::vector<Planning::CommandReceipt>& receipts, Core::Now now)
{
    for (const Planning::CommandReceipt& receipt : receipts)
    {
        Json::JsonDocument document;
        const Core::Result<const Json::Value*> answer = document.Parse(receipt.answer, Json::ParseLimits{});
        const Json::Value* const statusOrNull =
            answer.has_value() && (*answer)->IsObject() ? Json::FindFirstOrNull(**answer, "status") : nullptr;
        // The wall clock may have been set back since.
        const Core::Duration age =
            std::max(std::chrono::duration_cast<Core::Duration>(now.wall - receipt.time), Core::Duration::zero());
        if (statusOrNull == nullptr || !statusOrNull->IsUint() || age >= Planning::CommandReceipt::KEPT)
        {
            continue;
        }
        Apps::HttpResponse response{statusOrNull->GetUint(), "application/json"};
        response.body = GetString(**answer, "body");
        Add({{receipt.owner, receipt.key, GetString(**answer, "digest")}, std::move(response), now.steady - age});
    }
}

const IdempotencyKeys::Kept* IdempotencyKeys::FindOrNull(const std::string& owner, const std::string& key) const
{
    const auto found = std::ranges::find_if(_answers, [&](const Kept& answer) {
        return answer.used.key == key && answer.used.owner == owner;
    });
    return found == _answers.end() ? nullptr : &*found;
}

void IdempotencyKeys::Add(Kept answer)
{
    if (_answers.size() >= Planning::CommandReceipt::MOST_RECEIPTS)
    {
        _answers.pop_front();
    }
    _answers.push_back(std::move(answer));
}

} // namespace ACS::Acsd
