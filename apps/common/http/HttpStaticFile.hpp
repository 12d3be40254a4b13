#pragma once

#include "common/http/HttpMessage.hpp"

#include <string>
#include <string_view>

namespace ACS::Apps
{

/// A file of a web page that is part of the program. Browsers keep it and ask each time whether it has changed (ETag). The page
/// may load scripts, styles, images and data from the same server only, and no page may frame it.
class HttpStaticFile final
{
    std::string_view _contentType;
    std::string_view _contents;
    std::string _tag;

public:
    /// Both outlive the file.
    HttpStaticFile(std::string_view contentType, std::string_view contents);

    /// 200 with the contents, or 304 if the client has them.
    [[nodiscard]] HttpResponse Respond(const HttpRequest& request) const;
};

} // namespace ACS::Apps
