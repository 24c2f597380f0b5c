from .answers.run import LabelledPoints as LabelledPoints
from .answers.run import Run as Run
from .answers.run import open_run as open_run
from .settings import AppSettings as AppSettings
from .settings import load_settings as load_settings
