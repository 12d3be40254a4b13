#include "replay/InputCodec.hpp"

#include "replay/OperatorCommandCodec.hpp"
#include "replay/RobotEventCodec.hpp"
#include "replay/SessionEventCodec.hpp"
#include "replay/StateCodec.hpp"
#include "replay/TimerText.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/json/TextCodec.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

/// A result of the store.
struct ErrorOfStore
{
    std::optional<int> code; ///< An EPlanningError; nullopt: of another kind.
    std::string path;
    std::string expected;
    std::string found;
};

constexpr std::string_view RESTORE_KIND = "restore";
constexpr std::string_view START_KIND = "start";
constexpr std::string_view RELOAD_KIND = "reload";
constexpr std::string_view SESSION_KIND = "session";
constexpr std::string_view ROBOT_KIND = "robot";
constexpr std::string_view TIMER_KIND = "timer";
constexpr std::string_view MQTT_UP_KIND = "mqtt up";
constexpr std::string_view MQTT_DOWN_KIND = "mqtt down";
constexpr std::string_view STORED_KIND = "stored";
constexpr std::string_view NOT_STORED_KIND = "not stored";
constexpr std::string_view STORE_LOST_KIND = "store lost";
constexpr std::string_view STORE_LOG_KIND = "store log";
constexpr std::string_view OPERATOR_KIND = "operator";
constexpr std::string_view LINKS_CLOSED_KIND = "links closed";
constexpr std::string_view STOP_KIND = "stop";
constexpr std::string_view CLOSE_KIND = "close";

} // namespace

} // namespace ACS::Acsd

namespace ACS::Json
{

template <>
struct JsonFields<Acsd::ErrorOfStore>
{
    static constexpr auto FIELDS = std::make_tuple(
        Optional("code", &Acsd::ErrorOfStore::code),
        Optional("path", &Acsd::ErrorOfStore::path),
        Optional("expected", &Acsd::ErrorOfStore::expected),
        Optional("found", &Acsd::ErrorOfStore::found));
};

template <>
struct JsonFields<Planning::StoreLog>
{
    static constexpr auto FIELDS = std::make_tuple(
        Optional("path", &Planning::StoreLog::path),
        Required("bytes", &Planning::StoreLog::bytes),
        Required("freeBytes", &Planning::StoreLog::freeBytes),
        Optional("blockReason", &Planning::StoreLog::blockReason));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

namespace
{

std::string EncodeError(const Core::Error& error)
{
    const bool bOfPlanning = error.code.category() == make_error_code(Planning::EPlanningError::StoreFailed).category();
    return Json::EncodeText(ErrorOfStore{
        bOfPlanning ? std::optional(error.code.value()) : std::nullopt,
        error.path,
        error.expected,
        error.found});
}

Core::Result<Core::Error> DecodeError(std::string_view text)
{
    return Json::DecodeText<ErrorOfStore>(text).map([](ErrorOfStore&& read) {
        const std::error_code failed = make_error_code(Planning::EPlanningError::StoreFailed);
        return Core::Error{
            {read.code.value_or(failed.value()), failed.category()},
            std::move(read.path),
            std::move(read.expected),
            std::move(read.found)};
    });
}

CoreRecord MakeInputRecord(std::string_view kind, std::string text = {})
{
    CoreRecord record;
    record.bInput = true;
    record.kind = kind;
    record.text = std::move(text);
    return record;
}

CoreRecord MakeTimerRecord(const AcsdTimer& timer)
{
    CoreRecord record = MakeInputRecord(TIMER_KIND, EncodeTimer(timer, std::nullopt));
    if (const auto* const ofEngineOrNull = std::get_if<Planning::EngineTimer>(&timer))
    {
        record.robotID = ofEngineOrNull->robotID;
    }
    return record;
}

template <typename TValue>
Core::Result<CoreInput> AsInput(Core::Result<TValue> value)
{
    return std::move(value).map([](TValue&& read) { return CoreInput(std::move(read)); });
}

} // namespace

CoreRecord EncodeInput(const CoreInput& input)
{
    return std::visit(
        Core::Overloaded{
            [](const RestoreInput& restore) { return MakeInputRecord(RESTORE_KIND, EncodeState(restore.state)); },
            [](const StartInput&) { return MakeInputRecord(START_KIND); },
            [](const ReloadInput& reload) { return MakeInputRecord(RELOAD_KIND, reload.config); },
            [](const Protocol::SessionEvent& event) {
                CoreRecord record = MakeInputRecord(SESSION_KIND, EncodeSessionEvent(event));
                record.planID = FindPlanID(event);
                record.transactionID = FindTransactionID(event);
                return record;
            },
            [](const Planning::RobotInput& robot) {
                CoreRecord record = MakeInputRecord(ROBOT_KIND, EncodeRobotEvent(robot.event));
                record.robotID = robot.robotID;
                return record;
            },
            [](const AcsdTimer& timer) { return MakeTimerRecord(timer); },
            [](const MqttInput& mqtt) { return MakeInputRecord(mqtt.bUp ? MQTT_UP_KIND : MQTT_DOWN_KIND); },
            [](const StoredInput& stored) {
                return stored.errorOrNull.has_value()
                    ? MakeInputRecord(NOT_STORED_KIND, EncodeError(*stored.errorOrNull))
                    : MakeInputRecord(STORED_KIND);
            },
            [](const StoreLostInput& lost) { return MakeInputRecord(STORE_LOST_KIND, EncodeError(lost.error)); },
            [](const Planning::StoreLog& log) { return MakeInputRecord(STORE_LOG_KIND, Json::EncodeText(log)); },
            [](const OfferInput& offer) {
                CoreRecord record = MakeInputRecord(OPERATOR_KIND, EncodeOffer(offer));
                record.planID = FindPlanID(offer.command);
                record.robotID = FindRobotID(offer.command);
                return record;
            },
            [](const LinksClosedInput&) { return MakeInputRecord(LINKS_CLOSED_KIND); },
            [](const StopInput&) { return MakeInputRecord(STOP_KIND); },
            [](const CloseInput&) {
                return MakeInputRecord(CLOSE_KIND);
            }},
        input);
}

Core::Result<CoreInput> DecodeInput(const CoreRecord& record)
{
    const std::string& kind = record.kind;
    if (kind == RESTORE_KIND)
    {
        return DecodeState(record.text).map([](Planning::StoredState&& state) -> CoreInput {
            return RestoreInput{std::move(state)};
        });
    }
    if (kind == SESSION_KIND)
    {
        return AsInput(DecodeSessionEvent(record.text));
    }
    if (kind == ROBOT_KIND)
    {
        return DecodeRobotEvent(record.text).map([&record](Planning::RobotEvent&& event) -> CoreInput {
            return Planning::RobotInput{record.robotID, std::move(event)};
        });
    }
    if (kind == TIMER_KIND)
    {
        return AsInput(DecodeTimer(record.text, record.robotID));
    }
    if (kind == MQTT_UP_KIND || kind == MQTT_DOWN_KIND)
    {
        return MqttInput{kind == MQTT_UP_KIND};
    }
    if (kind == STORED_KIND)
    {
        return StoredInput{};
    }
    if (kind == NOT_STORED_KIND)
    {
        return DecodeError(record.text).map([](Core::Error&& error) -> CoreInput {
            return StoredInput{std::move(error)};
        });
    }
    if (kind == STORE_LOST_KIND)
    {
        return DecodeError(record.text).map([](Core::Error&& error) -> CoreInput {
            return StoreLostInput{std::move(error)};
        });
    }
    if (kind == STORE_LOG_KIND)
    {
        return AsInput(Json::DecodeText<Planning::StoreLog>(record.text));
    }
    if (kind == OPERATOR_KIND)
    {
        return AsInput(DecodeOffer(record.text));
    }
    if (kind == START_KIND)
    {
        return StartInput{};
    }
    if (kind == RELOAD_KIND)
    {
        return ReloadInput{record.text};
    }
    if (kind == LINKS_CLOSED_KIND)
    {
        return LinksClosedInput{};
    }
    if (kind == STOP_KIND)
    {
        return StopInput{};
    }
    if (kind == CLOSE_KIND)
    {
        return CloseInput{};
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "kind", "an input of acsd", Core::QuoteForError(kind));
}

} // namespace ACS::Acsd
