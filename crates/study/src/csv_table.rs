//! Tables of text as CSV (RFC 4180).

/// A head and rows of the same length, as the text of a file.
pub fn csv_text<I>(head: &[&str], rows: impl IntoIterator<Item = I>) -> Result<String, csv::Error>
where
    I: IntoIterator<Item = String>,
{
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(head)?;
    for row in rows {
        writer.write_record(row.into_iter().map(String::into_bytes))?;
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(test)]
mod tests {
    use super::csv_text;

    #[test]
    fn cells_with_commas_and_quotes_are_quoted() {
        let row = ["say \"no\"", "plain", ""].map(str::to_owned);
        assert_eq!(csv_text(&["a,b", "c", "d"], [row]).unwrap(), "\"a,b\",c,d\n\"say \"\"no\"\"\",plain,\n");
    }
}
