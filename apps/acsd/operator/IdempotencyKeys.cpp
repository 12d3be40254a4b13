#include "operator/IdempotencyKeys.hpp"

#include "operator/OperatorAnswer.hpp"
#include "operator/OperatorToken.hpp"
#include <acs/core/Result.hpp>
#include <acs/core/Timestamp.hpp>
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
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

/// nullopt if the line does not have the whole answer.
std::optional<Apps::HttpResponse> ReadAnswerOrNull(const Json::Value& line)
{
    const Json::Value* const statusOrNull = Json::FindFirstOrNull(line, "status");
    const Json::Value* const answerOrNull = Json::FindFirstOrNull(line, "answer");
    if (statusOrNull == nullptr || !statusOrNull->IsUint() || answerOrNull == nullptr)
    {
        return std::nullopt;
    }
    Apps::HttpResponse response{statusOrNull->GetUint(), "application/json"};
    response.body = answerOrNull->IsString() ? R"({"message":"The answer was not kept over the restart of acsd."})"
                                             : Json::WriteText(*answerOrNull);
    response.body += '\n';
    return response;
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
    std::erase_if(_answers, [now](const Kept& answer) { return now - answer.answeredAt >= KEPT; });
    const std::string owner = MakeOwner(GetText(identity.proof), identity.name);
    const CommandKey used{*key, MakeDigest(request), true};
    if (const Kept* const keptOrNull = FindOrNull(owner, *key); keptOrNull != nullptr)
    {
        if (keptOrNull->digest != used.digest)
        {
            return {MakeOperatorError(KEY_REUSED, "This Idempotency-Key was used for another request: use a new one.")};
        }
        Answer answer{keptOrNull->response, used};
        answer.response.headers.emplace_back("Idempotent-Replay", "true");
        return answer;
    }
    Apps::HttpResponse response = respond();
    if (response.status >= FIRST_NOT_KEPT)
    {
        return {std::move(response)};
    }
    Add({owner, *key, used.digest, response, now});
    return {std::move(response), {*key, used.digest, false}};
}

void IdempotencyKeys::Restore(std::string_view auditLines, Core::Now now)
{
    while (!auditLines.empty())
    {
        const std::size_t end = std::min(auditLines.find('\n'), auditLines.size());
        RestoreLine(auditLines.substr(0, end), now);
        auditLines.remove_prefix(std::min(end + 1, auditLines.size()));
    }
}

const IdempotencyKeys::Kept* IdempotencyKeys::FindOrNull(const std::string& owner, const std::string& key) const
{
    const auto found =
        std::ranges::find_if(_answers, [&](const Kept& answer) { return answer.key == key && answer.owner == owner; });
    return found == _answers.end() ? nullptr : &*found;
}

void IdempotencyKeys::Add(Kept answer)
{
    if (_answers.size() >= MOST_KEYS)
    {
        _answers.pop_front();
    }
    _answers.push_back(std::move(answer));
}

void IdempotencyKeys::RestoreLine(std::string_view text, Core::Now now)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> line = document.Parse(text, Json::ParseLimits{});
    if (!line.has_value() || !(*line)->IsObject())
    {
        return;
    }
    const std::string key = GetString(**line, "key");
    const Core::Result<Core::Timestamp> time = Core::ParseTimestamp(GetString(**line, "time"));
    std::optional<Apps::HttpResponse> response = ReadAnswerOrNull(**line);
    if (!IsKey(key) || Json::FindFirstOrNull(**line, "replay") != nullptr || !time.has_value() || !response.has_value())
    {
        return;
    }
    // The wall clock may have been set back since.
    const Core::Duration age =
        std::max(std::chrono::duration_cast<Core::Duration>(now.wall - time->time), Core::Duration::zero());
    const std::string owner = MakeOwner(GetString(**line, "proof"), GetString(**line, "name"));
    if (age < KEPT && FindOrNull(owner, key) == nullptr)
    {
        Add({owner, key, GetString(**line, "digest"), std::move(*response), now.steady - age});
    }
}

} // namespace ACS::Acsd
