// Probe files: point queries in, answers out (docs/schema/probe.schema.json, answers.schema.json).
#pragma once

#include <alpenglow/io/result.h>
#include <alpenglow/query.h>
#include <alpenglow/reference/reference.h>

#include <string>
#include <vector>

namespace alpenglow::io {

struct NamedQuery {
  std::string id;
  ProbeQuery query;
};

/// A bad query fails the whole file; the sentence names its id and field.
Result<std::vector<NamedQuery>> readQueries(const std::string& path);
Result<std::vector<NamedQuery>> parseQueries(const std::string& text, const std::string& name);

/// The content of an answers file, in the order of the queries, numbers with all their digits.
/// Fails when a value is not finite, naming the query's id and the field. `answers` has one for
/// each.
Result<std::string> formatAnswers(const std::vector<NamedQuery>& queries,
                                  const std::vector<ProbeAnswer>& answers);
/// With `standard_error`.
Result<std::string> formatAnswers(const std::vector<NamedQuery>& queries,
                                  const std::vector<ReferenceAnswer>& answers);

/// Answers as a file holds them: `standardError` is zero where the file has none.
Result<std::vector<ReferenceAnswer>> readAnswers(const std::string& path,
                                                 const std::vector<NamedQuery>& queries);
/// Fails unless the file has one answer of the right kind for each query, in the same order.
Result<std::vector<ReferenceAnswer>> parseAnswers(const std::string& text, const std::string& name,
                                                  const std::vector<NamedQuery>& queries);

}  // namespace alpenglow::io
