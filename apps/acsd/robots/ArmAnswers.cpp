#include "robots/ArmAnswers.hpp"

#include <acs/core/ParseNumber.hpp>
#include <acs/json/JsonDecoder.hpp>

#include <string>
#include <tuple>

namespace ACS::Acsd
{

/// The answer to GET motor_on_state.
struct MotorState
{
    std::int64_t value = 0;
};

/// The answer to GET rgen, in part.
struct GeneralAnswer
{
    std::int64_t isPlayback = 0;
    std::optional<std::int64_t> program;
    std::optional<std::int64_t> step;
};

/// The body of a refusal.
struct ErrorNumber
{
    std::int64_t code = 0;
};

/// Likewise, of other versions.
struct ErrorText
{
    std::string code;
};

} // namespace ACS::Acsd

template <>
struct ACS::Json::JsonFields<ACS::Acsd::ErrorNumber>
{
    static constexpr auto FIELDS = std::make_tuple(Required("err_code", &Acsd::ErrorNumber::code));
};

template <>
struct ACS::Json::JsonFields<ACS::Acsd::ErrorText>
{
    static constexpr auto FIELDS = std::make_tuple(Required("err_code", &Acsd::ErrorText::code));
};

template <>
struct ACS::Json::JsonFields<ACS::Acsd::MotorState>
{
    static constexpr auto FIELDS = std::make_tuple(Required("val", &Acsd::MotorState::value));
};

template <>
struct ACS::Json::JsonFields<ACS::Acsd::GeneralAnswer>
{
    using Message = Acsd::GeneralAnswer;
    static constexpr auto FIELDS = std::make_tuple(
        Required("is_playback", &Message::isPlayback),
        Optional("cur_prog_no", &Message::program),
        Optional("cur_step_no", &Message::step));
};

namespace ACS::Acsd
{

namespace
{

/// The only value on which the manuals of all versions agree.
constexpr std::int64_t MOTOR_IS_ON = 0;

template <typename T>
std::optional<T> ReadOrNull(const Core::JsonText& text)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(text.GetText(), {});
    Json::DecodeContext context;
    T value{};
    if (!root || !Json::TryDecode(**root, value, Json::FieldBounds{}, context))
    {
        return std::nullopt;
    }
    return value;
}

} // namespace

std::optional<bool> ReadMotorOnOrNull(const Core::JsonText& sample)
{
    const std::optional<MotorState> stateOrNull = ReadOrNull<MotorState>(sample);
    return stateOrNull.has_value() ? std::optional(stateOrNull->value == MOTOR_IS_ON) : std::nullopt;
}

std::optional<GeneralState> ReadGeneralStateOrNull(const Core::JsonText& sample)
{
    const std::optional<GeneralAnswer> answerOrNull = ReadOrNull<GeneralAnswer>(sample);
    if (!answerOrNull.has_value())
    {
        return std::nullopt;
    }
    return GeneralState{answerOrNull->isPlayback != 0, answerOrNull->program, answerOrNull->step};
}

std::optional<std::vector<std::int64_t>> ReadRelayWordsOrNull(const Core::JsonText& sample)
{
    return ReadOrNull<std::vector<std::int64_t>>(sample);
}

std::optional<std::int64_t> ReadErrorCodeOrNull(const Core::JsonText& body)
{
    if (const std::optional<ErrorNumber> numberOrNull = ReadOrNull<ErrorNumber>(body); numberOrNull.has_value())
    {
        return numberOrNull->code;
    }
    return Core::ParseNumberOrNull<std::int64_t>(ReadOrNull<ErrorText>(body).value_or(ErrorText{}).code);
}

} // namespace ACS::Acsd
