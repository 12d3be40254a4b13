#include "replay/JobCheckText.hpp"

#include "replay/RecordKind.hpp"
#include <acs/json/TextCodec.hpp>

#include <utility>

namespace ACS::Acsd
{

namespace
{

struct RejectionText
{
    std::string job;
    std::string reason;
};

} // namespace

} // namespace ACS::Acsd

namespace ACS::Json
{

template <>
struct JsonFields<Acsd::RejectionText>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("job", &Acsd::RejectionText::job), Required("reason", &Acsd::RejectionText::reason));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

CoreRecord EncodeRejection(const JobRejection& rejection)
{
    CoreRecord record;
    record.kind = JOB_CHECK_KIND;
    record.robotID = rejection.robotID;
    record.text = Json::EncodeText(RejectionText{rejection.job, rejection.reason});
    return record;
}

Core::Result<JobRejection> DecodeRejection(const CoreRecord& record)
{
    return Json::DecodeText<RejectionText>(record.text).map([&record](RejectionText&& read) {
        return JobRejection{record.robotID, std::move(read.job), std::move(read.reason)};
    });
}

} // namespace ACS::Acsd
