"""Files converted by LibreOffice."""
import subprocess


def convert(folder, kind, file, out, *options):
    """Converts a file into the folder `out`, with a profile of its own in `folder`."""
    subprocess.run(["soffice", "--headless", f"-env:UserInstallation=file://{folder}/profile", *options, "--convert-to", kind,
                    "--outdir", str(out), str(file)], check=True, capture_output=True, timeout=300)
    return out
